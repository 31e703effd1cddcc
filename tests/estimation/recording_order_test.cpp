// Recordings of motions known in closed form, shuffled, duplicated, wrapped at a turn and cut: the
// motion is recovered, or the error is reported.
#include <gmock/gmock.h>

#include <algorithm>
#include <cmath>
#include <random>
#include <string>
#include <vector>

#include "algebra/constants.h"
#include "estimation/run_units.h"
#include "messages/input_error.h"

namespace whirl_twin {
namespace recording_order_test {

using testing::AnyOf;
using testing::HasSubstr;

struct Row {
  double time = 0.0, angle = 0.0;
};

/// theta = drift t + swing sin(w t): goes round, turns back, or stays within a turn.
struct Motion {
  double drift = 0.0, swing = 1.0, w = 5.0;

  double at(double time) const { return drift * time + swing * std::sin(w * time); }
  std::vector<Row> rows(int count, double step) const {
    std::vector<Row> all;
    for (int i = 0; i < count; ++i) {
      all.push_back({step * i, at(step * i)});
    }
    return all;
  }
};

std::vector<Row> wrapped(std::vector<Row> rows, double low) {
  for (Row& row : rows) {
    row.angle -= kTwoPi * std::floor((row.angle - low) / kTwoPi);
  }
  return rows;
}

StudyRun settled(const std::vector<Row>& rows, std::optional<bool> wrap = std::nullopt) {
  std::vector<double> time;
  MeasuredColumn column{"q", {}};
  for (const Row& row : rows) {
    time.push_back(row.time);
    column.values.push_back(row.angle);
  }
  StudyRun run;
  run.data = measuredRun(time, {column});
  MeasuredChannel channel;
  channel.name = "theta";
  channel.unit = "rad";
  channel.column = "q";
  channel.wrap = wrap;
  run.measured = {channel};
  settleUnits(run, {}, 0.001);
  return run;
}

std::string inputError(const std::vector<Row>& rows, std::optional<bool> wrap = std::nullopt) {
  try {
    settled(rows, wrap);
  } catch (const InputError& error) {
    return error.what();
  }
  return "";
}

/// The motion, whole turns aside that all rows have. In a gap turns may be missed where no row
/// shows that the column counts within a turn.
void expectMotion(const MeasuredRun& run, const Motion& motion, std::size_t rows) {
  ASSERT_EQ(run.time.size(), rows);
  const std::vector<double>& x = run.column("q");
  const bool shown = std::any_of(
      run.remarks.begin(), run.remarks.end(),
      [](const std::string& remark) { return remark.find("within a turn") != std::string::npos; });
  double turns = 0.0;
  for (std::size_t i = 0; i < rows; ++i) {
    ASSERT_TRUE(i == 0 || run.time[i] > run.time[i - 1]);
    if (i == 0 || (!shown && run.time[i] > run.time[i - 1] + 0.05)) {
      turns = std::round((x[i] - motion.at(run.time[i])) / kTwoPi);
    }
    ASSERT_NEAR(x[i] - kTwoPi * turns, motion.at(run.time[i]), 1.0e-9) << "at " << run.time[i];
  }
}

TEST(RecordingOrder, WhateverBecomesOfARecordingTheMotionComesOutOrTheCauseIsNamed) {
  std::mt19937 random(1);
  const auto dice = [&](int sides) {
    return static_cast<int>(random() % static_cast<unsigned>(sides));
  };
  const std::vector<Motion> motions = {
      {0.0, 1.5, 5.0}, {0.0, 2.9, 3.0}, {9.0, 1.0, 4.0}, {-25.0, 2.0, 3.0}, {2.0, 4.0, 2.0}};
  int right = 0;
  constexpr int kTrials = 600;
  for (int trial = 0; trial < kTrials; ++trial) {
    SCOPED_TRACE(trial);
    const Motion motion = motions[static_cast<std::size_t>(dice(5))];
    std::vector<Row> rows = motion.rows(300, 0.01);
    if (dice(2) == 0) {
      rows = wrapped(rows, std::vector<double>{-kPi, 0.0, -1.0}[static_cast<std::size_t>(dice(3))]);
    }
    if (dice(2) == 0) {  // cut at an end, or within
      const auto from = rows.begin() + dice(200);
      rows.erase(from, dice(2) == 0 ? rows.end() - std::min<std::ptrdiff_t>(rows.end() - from, 40)
                                    : from + dice(60));
    }
    const std::size_t different = rows.size();
    if (dice(2) == 0) {  // some come twice
      for (int i = dice(100); i > 0; --i) {
        const Row again = rows[static_cast<std::size_t>(dice(static_cast<int>(different)))];
        rows.insert(dice(2) == 0 ? rows.end() : rows.begin() + dice(50), again);
      }
    }
    const int order = dice(5);
    if (order == 1) {
      std::shuffle(rows.begin(), rows.end(), random);
    } else if (order == 2) {
      std::rotate(rows.begin(), rows.begin() + dice(static_cast<int>(rows.size())), rows.end());
    } else if (order == 3) {
      std::stable_partition(rows.begin(), rows.end(), [&](const Row&) { return dice(2) == 0; });
    } else if (order == 4) {  // the newest first
      std::reverse(rows.begin(), rows.end());
    }
    try {
      expectMotion(settled(rows).data, motion, different);
      ++right;
    } catch (const InputError& error) {
      EXPECT_THAT(error.what(), AnyOf(HasSubstr("in the gap"), HasSubstr("must have 5 rows")));
    }
    ASSERT_FALSE(HasFatalFailure());
  }
  EXPECT_GT(right, kTrials * 8 / 10);
}

TEST(RecordingOrder, TheTimeThatGoesBackIsRemarked) {
  std::vector<Row> rows = Motion().rows(100, 0.01);
  std::rotate(rows.begin(), rows.begin() + 40, rows.end());
  EXPECT_THAT(settled(rows).data.remarks.front(),
              HasSubstr("the time goes back at 1 row, the first is row 61: sorted by time"));
}

TEST(RecordingOrder, TwoRunsInOneFileAreRefused) {
  for (const double offset : {0.0, 0.003}) {  // with the same instants, and with others
    std::vector<Row> rows = Motion().rows(100, 0.01);
    for (Row row : Motion{0.0, 0.2, 5.0}.rows(100, 0.01)) {
      rows.push_back({row.time + offset, row.angle});
    }
    EXPECT_THAT(inputError(rows), HasSubstr("row 101: the time goes back"));
    EXPECT_THAT(inputError(rows), HasSubstr("must be one run, found two"));
  }
}

TEST(RecordingOrder, WhatCountsOnIsNotUnwrapped) {
  const Motion fast{420.0, 0.3, 5.0};  // 4.2 rad from row to row
  expectMotion(settled(fast.rows(100, 0.01)).data, fast, 100);
  const Motion round{9.0, 1.0, 4.0};
  expectMotion(settled(round.rows(300, 0.01)).data, round, 300);
  EXPECT_EQ(settled(round.rows(300, 0.01)).data.column("q").front(), 0.0);
  const StudyRun kept = settled(wrapped(round.rows(300, 0.01), 0.0), false);
  EXPECT_LT(kept.data.column("q").back(), kTwoPi);
  EXPECT_THAT(kept.data.remarks.front(), HasSubstr("jumps by"));
}

TEST(RecordingOrder, AnEncoderOfSomeTurnsIsUnwrapped) {
  const Motion motion{30.0, 1.0, 4.0};
  std::vector<Row> rows = motion.rows(300, 0.01);
  for (Row& row : rows) {
    row.angle = std::fmod(row.angle, 4.0 * kTwoPi);
  }
  expectMotion(settled(rows).data, motion, rows.size());
}

TEST(RecordingOrder, ADirectionThatIsNotKnownIsSaid) {
  const Motion fast{250.0, 0.0, 1.0};  // 2.5 rad from row to row
  EXPECT_THAT(inputError(wrapped(fast.rows(100, 0.01), 0.0)), HasSubstr("three rows per turn"));
  std::vector<Row> rows = wrapped(Motion{9.0, 1.0, 4.0}.rows(300, 0.01), -kPi);
  rows.erase(rows.begin() + 100, rows.begin() + 160);
  EXPECT_THAT(inputError(rows), HasSubstr("may have turned further in the gap of 0.61 s"));
  // A swing of less than a turn with a jump in a gap may be wrapped or not.
  std::vector<Row> swing = Motion{0.0, 2.5, 5.0}.rows(110, 0.01);
  swing.erase(swing.begin() + 35, swing.begin() + 85);  // from 2.5 to -2.2 rad
  EXPECT_THAT(inputError(swing), HasSubstr("set `wrap: true` if the angle is within one turn"));
  EXPECT_EQ(inputError(swing, false), "");
}

}  // namespace recording_order_test
}  // namespace whirl_twin

// A recorded run: anomalies are reported with their rows, and unusable data are rejected.
#include "estimation/measured_run.h"

#include <gmock/gmock.h>
#include <unistd.h>

#include <cmath>
#include <cstdio>
#include <fstream>
#include <functional>

#include "messages/input_error.h"

namespace whirl_twin {
namespace measured_run_test {

using testing::ElementsAre;
using testing::HasSubstr;

MeasuredRun read(const std::string& text) {
  const std::string path = "/tmp/whirl_twin_run_" + std::to_string(::getpid()) + ".csv";
  std::ofstream(path, std::ios::binary) << text;
  const auto remove = [&] { std::remove(path.c_str()); };
  try {
    MeasuredRun run = readMeasuredRun(path, {}, {{"a"}});
    remove();
    return run;
  } catch (...) {
    remove();
    throw;
  }
}

std::string inputError(const std::string& text) {
  try {
    read(text);
  } catch (const InputError& error) {
    return error.what();
  }
  return "";
}

/// Rows of an instant and a value, a millisecond apart.
std::string rows(int count, const std::function<double(int)>& value) {
  std::string text = "t,a\n";
  for (int i = 0; i < count; ++i) {
    text += std::to_string(0.001 * i) + "," + std::to_string(value(i)) + "\n";
  }
  return text;
}

TEST(MeasuredRun, OfEvenStepsHasNoRemarks) {
  const MeasuredRun run = read(rows(500, [](int i) { return std::sin(0.02 * i); }));
  EXPECT_THAT(run.remarks, ElementsAre());
  EXPECT_EQ(run.time.size(), 500u);
  EXPECT_NEAR(run.duration(), 0.499, 1e-12);
  EXPECT_NEAR(run.column("a")[100], std::sin(2.0), 1e-6);
}

TEST(MeasuredRun, LeavesRepeatedInstantsOut) {
  const MeasuredRun run = read("t,a\n0,1\n0,2\n1,3.5\n2,4\n2,5\n3,6\n4,7\n");
  EXPECT_THAT(run.time, ElementsAre(0, 1, 2, 3, 4));
  EXPECT_THAT(run.column("a"), ElementsAre(1, 3.5, 4, 6, 7));
  EXPECT_THAT(run.remarks.front(), HasSubstr("2 rows at the same instant as the one before"));
  EXPECT_THAT(run.remarks.front(), HasSubstr("row 2"));
}

TEST(MeasuredRun, LeavesOutARowThatIsCut) {  // 9 may be the beginning of 9.75
  for (const char* last : {"6,9", "6,9e", "6,", "6"}) {
    const MeasuredRun run = read(std::string("t,a\n0,1\n1,2.5\n2,4\n3,5\n4,7\n5,8.25\n") + last);
    EXPECT_EQ(run.time.back(), 5.0) << last;
    EXPECT_THAT(run.remarks.back(), HasSubstr("ends within a line")) << last;
  }
}

TEST(MeasuredRun, NamesAGap) {
  const MeasuredRun run = read("t,a\n0,1\n1,2\n2,3\n3,4\n40,5.5\n41,6\n");
  ASSERT_EQ(run.remarks.size(), 2u);  // the column is coarse, too
  EXPECT_THAT(run.remarks[0], HasSubstr("1 gap"));
  EXPECT_THAT(run.remarks[0], HasSubstr("37 s, before row 5"));
}

TEST(MeasuredRun, NamesAColumnThatStands) {
  const auto stuck = [](int i) { return std::sin(0.01 * (i < 400 || i > 900 ? i : 400)); };
  const MeasuredRun run = read(rows(2000, stuck));
  ASSERT_EQ(run.remarks.size(), 1u);
  EXPECT_THAT(run.remarks[0], HasSubstr("for 0.5 s from row 401 on: stuck?"));

  const auto clipped = [](int i) { return std::min(0.5, std::sin(0.005 * i)); };
  EXPECT_THAT(read(rows(2000, clipped)).remarks[0], HasSubstr("an end of its range: saturated?"));
  EXPECT_THAT(read(rows(2000, [](int) { return 3.0; })).remarks[0], HasSubstr("in every row"));
}

TEST(MeasuredRun, NamesCoarseSteps) {
  const auto coarse = [](int i) { return 0.1 * std::round(10.0 * std::sin(0.05 * i)); };
  EXPECT_THAT(read(rows(900, coarse)).remarks[0], HasSubstr("in steps of 0.1, 5 % of its range"));
}

TEST(MeasuredRun, RefusesWhatCannotBeMeant) {
  EXPECT_THAT(inputError("t,a\n0,1\n2,2\n1,3\n3,4\n2,5\n5,6\n"),
              HasSubstr("rows 2 and 5 have different values of 'a' at 2 s"));
  EXPECT_THAT(inputError("t,a\n0,1\n1,2,7\n"), HasSubstr("line 3: expected at most 2 values"));
  EXPECT_THAT(inputError("t,a\n0,1\n1,2\n"), HasSubstr("must have 5 rows of different instants"));
  EXPECT_THAT(inputError("t,b\n0,1\n1,2\n"), HasSubstr("no column 'a'"));
  EXPECT_THAT(inputError("t,a\n0,1\n1,x\n"),
              HasSubstr("line 3: a must be a finite number, found 'x'"));
  EXPECT_THAT(inputError("t,a\n0,1\n1e99,2\n"),
              HasSubstr("line 3: the time must be within 9e+09 s"));
}

}  // namespace measured_run_test
}  // namespace whirl_twin

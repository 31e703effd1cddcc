// Barred speed ranges of a shaft: shifting of targets, merging, crossing at full acceleration only
// for any sequence of commands, and that plans allocate nothing.
#include "control/exclusion_bands.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <random>

#include "../realtime/allocation_guard.h"
#include "messages/input_error.h"

namespace whirl_twin {
namespace exclusion_bands_test {

const double kNone = std::numeric_limits<double>::quiet_NaN();

/// Speed and acceleration a time [s] after the start of a plan.
SpeedSegment at(const BandedChange& plan, double time) {
  for (std::size_t i = 0; i < plan.count; ++i) {
    for (std::size_t k = 0; k < plan.changes[i].count; ++k) {
      const SpeedSegment& piece = plan.changes[i].segments[k];
      if (time <= piece.duration) {
        return {0.0, piece.speed + time * (piece.acceleration + 0.5 * time * piece.jerk),
                piece.acceleration + time * piece.jerk, piece.jerk};
      }
      time -= piece.duration;
    }
  }
  return {0.0, plan.speeds[plan.count - 1], 0.0, 0.0};
}

/// Time [s] that a plan is inside a band, from 20000 samples.
double timeInside(const BandedChange& plan, const SpeedBand& band) {
  constexpr int kLooks = 20000;
  int inside = 0;
  for (int i = 0; i < kLooks; ++i) {
    inside += band.holds(at(plan, plan.duration * (i + 0.5) / kLooks).speed) ? 1 : 0;
  }
  return plan.duration * inside / kLooks;
}

TEST(ExclusionBands, MergeWhereTheyOverlap) {
  const ExclusionBands bands({{30, 40}, {10, 20}, {35, 50}, {20, 21}});
  const auto& merged = bands.bands();
  ASSERT_EQ(merged.size(), 6u) << "of both senses; bands that touch leave a speed between them";
  EXPECT_EQ(merged[3].from, 10);
  EXPECT_EQ(merged[5].from, 30);
  EXPECT_EQ(merged[5].to, 50);
  EXPECT_EQ(merged[0].from, -50);
}

TEST(ExclusionBands, SendATargetToAnEdge) {
  const ExclusionBands bands({{54, 66}}, 0.1);
  const auto allowed = [&](double target, double before) {
    return bands.allowed(target, 5.0, 0.0, before);
  };
  EXPECT_EQ(allowed(60.0, kNone), 66.0) << "from the centre on up";
  EXPECT_EQ(allowed(59.9, kNone), 54.0);
  EXPECT_EQ(allowed(-59.9, kNone), -54.0);
  EXPECT_EQ(allowed(54.0, kNone), 54.0);
  EXPECT_EQ(allowed(66.0, kNone), 66.0);
  EXPECT_EQ(allowed(0.0, kNone), 0.0);
  // 0.1 of 12 rad/s about 60.
  EXPECT_EQ(allowed(61.1, 54.0), 54.0);
  EXPECT_EQ(allowed(61.3, 54.0), 66.0);
  EXPECT_EQ(allowed(58.9, 66.0), 66.0);
  EXPECT_EQ(allowed(58.7, 66.0), 54.0);
}

TEST(ExclusionBands, AreOneAcrossAGapTooShortToStopIn) {
  // A run-up of 5^2 / (2 * 2) = 6.25 rad/s.
  const ExclusionBands bands({{40, 50}, {56, 70}});
  EXPECT_EQ(bands.allowed(53.0, 5.0, 2.0, kNone), 40.0);
  EXPECT_EQ(bands.allowed(55.0, 5.0, 2.0, kNone), 70.0);
  EXPECT_EQ(bands.allowed(53.0, 5.0, 3.0, kNone), 53.0);
}

// 12 rad/s at 5 rad/s^2 take 2.4 s; started at rest on the edge they would take 3.65 s.
TEST(ExclusionBands, AreCrossedAtFullAcceleration) {
  const SpeedBand band{54, 66};
  const ExclusionBands bands({band});
  const SpeedMove up{100.0, 5.0, 2.0, 0.0};

  const BandedChange straight = bands.plan(0.0, 0.0, up);
  ASSERT_EQ(straight.count, 1u);
  EXPECT_DOUBLE_EQ(straight.duration, planSpeedChange(0.0, 0.0, up).duration);
  EXPECT_NEAR(timeInside(straight, band), 2.4, 2e-3);

  BandedChange edge;
  edge.changes[0] = planSpeedChange(54.0, 0.0, up);
  edge.speeds[0] = 100.0;
  edge.count = 1;
  edge.duration = edge.changes[0].duration;
  EXPECT_NEAR(timeInside(edge, band), 3.65, 2e-3);

  const BandedChange back = bands.plan(54.0, 0.0, up);
  ASSERT_EQ(back.count, 2u);
  EXPECT_DOUBLE_EQ(back.speeds[0], 54.0 - 6.25);
  EXPECT_NEAR(timeInside(back, band), 2.4, 2e-3);
  EXPECT_EQ(bands.plan(54.0 - 6.25, 0.0, up).count, 1u);

  const BandedChange onto = bands.plan(0.0, 0.0, {66.0, 5.0, 2.0, 0.0});
  ASSERT_EQ(onto.count, 2u);
  EXPECT_DOUBLE_EQ(onto.speeds[0], 66.0 + 6.25);
  EXPECT_EQ(onto.speeds[1], 66.0);
  EXPECT_NEAR(timeInside(onto, band), 2.4, 2e-3);
}

TEST(ExclusionBands, AreLeftByTheEdgeThatIsReachedFirst) {
  const ExclusionBands bands({{54, 66}});
  // At rest inside, 4 rad/s from the lower edge: sqrt(2 * 4 / 2) s, and it stops as far beyond.
  const BandedChange down = bands.plan(58.0, 0.0, {100.0, 5.0, 2.0, 0.0});
  ASSERT_GE(down.count, 2u);
  EXPECT_DOUBLE_EQ(down.speeds[0], 50.0);
  const BandedChange up = bands.plan(63.0, 0.0, {0.0, 5.0, 2.0, 0.0});
  EXPECT_DOUBLE_EQ(up.speeds[0], 69.0);
  // At full acceleration it continues, whatever the new target.
  const BandedChange on = bands.plan(55.0, 5.0, {20.0, 5.0, 2.0, 0.0});
  EXPECT_DOUBLE_EQ(on.speeds[0], 66.0 + 6.25);
  // So does what cannot stop any more.
  const BandedChange committed = bands.plan(53.0, 5.0, {20.0, 5.0, 2.0, 0.0});
  EXPECT_DOUBLE_EQ(committed.speeds[0], 66.0 + 6.25);
}

// Of a rotor on a stop: it does not run backward for a run-up.
TEST(ExclusionBands, NearRestAreCrossedAtWhatRestAllows) {
  const ExclusionBands bands({{3, 5}});
  const BandedChange stop = bands.plan(50.0, 0.0, {0.0, 5.0, 2.0, 0.0});
  const BandedChange start = bands.plan(2.5, 0.0, {50.0, 5.0, 2.0, 0.0});
  for (const BandedChange& plan : {stop, start}) {
    for (int i = 0; i <= 1000; ++i) {
      EXPECT_GE(at(plan, plan.duration * i / 1000).speed, -1e-9);
    }
  }
  EXPECT_EQ(stop.speeds[stop.count - 1], 0.0);
  ASSERT_EQ(start.count, 2u);
  EXPECT_EQ(start.speeds[0], 0.0);
}

// Commands at any time: bands are crossed, and at full acceleration only.
TEST(ExclusionBands, HoldNothingWhateverIsCommanded) {
  std::mt19937_64 random(11);
  std::uniform_real_distribution<double> unit(0.0, 1.0);
  constexpr int kSequences = 10000;
  constexpr int kCommands = 10;
  int crossings = 0;
  for (int sequence = 0; sequence < kSequences; ++sequence) {
    const double limit = std::pow(10.0, 2.0 * unit(random));
    const double jerk = sequence % 8 == 0 ? 0.0 : limit * std::pow(10.0, 2.0 * unit(random) - 0.5);
    const double run_up = jerk == 0.0 ? 0.0 : limit * limit / (2.0 * jerk);
    std::vector<SpeedBand> given;
    for (int i = 0; i < 1 + sequence % 4; ++i) {
      const double from = run_up + 1.0 + 300.0 * unit(random);
      given.push_back({from, from + 1.0 + 40.0 * unit(random)});
    }
    const ExclusionBands bands(given);
    double target = bands.allowed(400.0 * unit(random), limit, jerk, kNone);
    double v = target;
    double a = 0.0;
    for (int command = 0; command < kCommands; ++command) {
      target = bands.allowed(500.0 * unit(random) - 50.0, limit, jerk, target);
      const BandedChange plan = bands.plan(v, a, {target, limit, jerk, 0.0});
      const double rounding = 1e-9 * (500.0 + run_up);
      if (plan.count == 0) {
        ASSERT_NEAR(v, target, rounding);
        continue;
      }
      ASSERT_EQ(plan.speeds[plan.count - 1], target);
      SpeedSegment before{0.0, v, a, 0.0};
      for (std::size_t i = 0; i < plan.count; ++i) {
        for (std::size_t k = 0; k < plan.changes[i].count; ++k) {
          const SpeedSegment& piece = plan.changes[i].segments[k];
          ASSERT_NEAR(piece.speed, before.speed, rounding);
          for (int look = 0; look <= 12; ++look) {
            const double t = piece.duration * look / 12;
            const double speed = piece.speed + t * (piece.acceleration + 0.5 * t * piece.jerk);
            const double acceleration = piece.acceleration + t * piece.jerk;
            for (const SpeedBand& band : bands.bands()) {
              if (speed > band.from + rounding && speed < band.to - rounding) {
                ASSERT_GE(std::abs(acceleration), limit * (1.0 - 1e-9))
                    << "sequence " << sequence << " command " << command << " from " << v << ", "
                    << a << " to " << target << " at " << speed << " in " << band.from << " to "
                    << band.to << ", A " << limit << " J " << jerk;
                ++crossings;
              }
            }
            before = {0.0, speed, acceleration, 0.0};
          }
        }
      }
      const SpeedSegment now = at(plan, 1.1 * plan.duration * unit(random));
      v = now.speed;
      a = now.acceleration;
    }
  }
  EXPECT_GT(crossings, 100000);
}

TEST(ExclusionBands, RefuseWhatIsNoBand) {
  EXPECT_THROW(ExclusionBands({{5, 4}}), InputError);
  EXPECT_THROW(ExclusionBands({{0, 4}}), InputError);
  EXPECT_THROW(ExclusionBands({{kNone, 4}}), InputError);
  EXPECT_THROW(ExclusionBands({{1, 1e7}}), InputError);
  EXPECT_THROW(ExclusionBands({{1, 2}}, 0.6), InputError);
}

TEST(ExclusionBands, AllocateNothing) {
  const ExclusionBands bands({{54, 66}, {100, 120}});
  double sum = 0.0;
  const AllocationGuard guard;
  for (int i = 0; i < 200; ++i) {
    const double target = bands.allowed(i, 5.0, 2.0, kNone);
    sum += bands.plan(0.5 * i, 1.0, {target, 5.0, 2.0, 0.0}).duration;
  }
  EXPECT_EQ(guard.allocations(), 0u);
  EXPECT_GT(sum, 0.0);
}

}  // namespace exclusion_bands_test
}  // namespace whirl_twin

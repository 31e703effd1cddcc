// A change of speed keeps within its limits, is continuous, ends where it should, and is bang-bang,
// as the fastest one must be.
#include "control/speed_profile.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <random>

namespace whirl_twin {
namespace speed_profile_test {

// Speed and acceleration at the end of a piece.
SpeedSegment endOf(const SpeedSegment& piece) {
  const double t = piece.duration;
  return {0.0, piece.speed + t * (piece.acceleration + 0.5 * t * piece.jerk),
          piece.acceleration + t * piece.jerk, piece.jerk};
}

// Largest absolute speed in the computation of a change: the scale of its rounding.
double speedScale(double speed, double acceleration, const SpeedMove& move) {
  return std::abs(speed) + std::abs(move.speed) +
         acceleration * acceleration / (2.0 * move.max_jerk);
}

TEST(SpeedChange, WithAHoldLastsSpeedOverAccelerationPlusAccelerationOverJerk) {
  const SpeedChange change = planSpeedChange(0.0, 0.0, {300.0, 20.0, 200.0, 0.0});
  ASSERT_EQ(change.count, 3u);
  EXPECT_NEAR(change.duration, 300.0 / 20.0 + 20.0 / 200.0, 1e-14);
  EXPECT_DOUBLE_EQ(change.segments[0].duration, 0.1);
  EXPECT_DOUBLE_EQ(change.segments[1].acceleration, 20.0);
}

TEST(SpeedChange, TooShortForTheLimitPeaksAtTheRootOfJerkTimesSpeed) {
  const SpeedChange change = planSpeedChange(5.0, 0.0, {4.0, 20.0, 200.0, 0.0});
  ASSERT_EQ(change.count, 2u);
  EXPECT_DOUBLE_EQ(change.segments[1].acceleration, -std::sqrt(200.0));
  EXPECT_DOUBLE_EQ(change.duration, 2.0 / std::sqrt(200.0));
}

TEST(SpeedChange, WithoutAJerkLimitHasConstantAcceleration) {
  const SpeedChange change = planSpeedChange(100.0, 7.0, {-20.0, 8.0, 0.0, 0.0});
  ASSERT_EQ(change.count, 1u);
  EXPECT_DOUBLE_EQ(change.duration, 15.0);
  EXPECT_DOUBLE_EQ(change.segments[0].acceleration, -8.0);
}

TEST(SpeedChange, ToThePresentSpeedIsEmpty) {
  EXPECT_EQ(planSpeedChange(100.0, 0.0, {100.0, 8.0, 10.0, 0.0}).count, 0u);
  EXPECT_EQ(planSpeedChange(100.0, 0.0, {100.0, 8.0, 0.0, 0.0}).count, 0u);
}

TEST(SpeedChange, ToTheStoppingSpeedOnlyBringsTheAccelerationToZero) {
  // 8^2 / (2 * 4) = 8 rad/s are gained on the way to zero acceleration.
  for (const double sign : {1.0, -1.0}) {
    const SpeedChange change = planSpeedChange(0.0, sign * 8.0, {sign * 8.0, 8.0, 4.0, 0.0});
    ASSERT_EQ(change.count, 1u);
    EXPECT_DOUBLE_EQ(change.duration, 2.0);
    EXPECT_DOUBLE_EQ(change.segments[0].jerk, -sign * 4.0);
  }
}

TEST(SpeedChange, StartingAboveTheAccelerationLimitComesDownToItAtFullJerk) {
  const SpeedChange change = planSpeedChange(0.0, 30.0, {100.0, 10.0, 5.0, 0.0});
  ASSERT_EQ(change.count, 3u);
  EXPECT_DOUBLE_EQ(change.segments[0].duration, 4.0);
  EXPECT_DOUBLE_EQ(change.segments[0].jerk, -5.0);
  EXPECT_DOUBLE_EQ(change.segments[1].speed, 80.0);
  EXPECT_DOUBLE_EQ(change.segments[1].acceleration, 10.0);
  // 80 rad/s are reached at the limit, 10 more on the way to zero: 10 are left for the hold.
  EXPECT_DOUBLE_EQ(change.segments[1].duration, 1.0);
}

TEST(SpeedChange, BeyondReachReversesTheAcceleration) {
  // Accelerating at 10 rad/s^2, the lowest speed reachable with 10 rad/s^3 is 5 rad/s; 0 is
  // requested.
  const SpeedChange change = planSpeedChange(0.0, 10.0, {0.0, 100.0, 10.0, 0.0});
  ASSERT_EQ(change.count, 2u);
  EXPECT_DOUBLE_EQ(change.segments[0].jerk, -10.0);
  EXPECT_DOUBLE_EQ(change.segments[1].acceleration, -std::sqrt(50.0));
}

TEST(SpeedChange, RandomChangesAreContinuousWithinLimitsAndBangBang) {
  std::mt19937_64 random(3);
  std::uniform_real_distribution<double> unit(-1.0, 1.0);
  std::uniform_real_distribution<double> decade(-1.0, 3.0);
  for (int i = 0; i < 20000; ++i) {
    const SpeedMove move{1e3 * unit(random), std::pow(10.0, decade(random)),
                         std::pow(10.0, decade(random)), 0.0};
    const double speed = 1e3 * unit(random);
    const double acceleration = i % 4 == 0 ? 0.0 : 2.0 * move.max_acceleration * unit(random);
    const SpeedChange change = planSpeedChange(speed, acceleration, move);
    ASSERT_GE(change.count, 1u);

    const double allowed = std::max(move.max_acceleration, std::abs(acceleration));
    // A few roundings at the scale of the speeds and accelerations that enter.
    const double speed_rounding = 1e-15 * 8.0 * speedScale(speed, acceleration, move);
    const double acceleration_rounding = 1e-15 * 4.0 * allowed;
    SpeedSegment before{0.0, speed, acceleration, 0.0};
    for (std::size_t k = 0; k < change.count; ++k) {
      const SpeedSegment& piece = change.segments[k];
      ASSERT_GT(piece.duration, 0.0);
      ASSERT_NEAR(piece.speed, before.speed, speed_rounding);
      ASSERT_NEAR(piece.acceleration, before.acceleration, acceleration_rounding);
      ASSERT_LE(std::abs(piece.acceleration), allowed);
      ASSERT_LE(std::abs(piece.jerk), move.max_jerk);
      const bool full_jerk = std::abs(piece.jerk) == move.max_jerk;
      const bool at_limit =
          piece.jerk == 0.0 && std::abs(piece.acceleration) == move.max_acceleration;
      ASSERT_TRUE(full_jerk || at_limit);
      before = endOf(piece);
    }
    ASSERT_NEAR(before.speed, move.speed, speed_rounding);
    ASSERT_NEAR(before.acceleration, 0.0, acceleration_rounding);
  }
}

TEST(SpeedChange, IsTheSameEitherWayRound) {
  const SpeedChange up = planSpeedChange(3.0, 2.0, {50.0, 4.0, 5.0, 0.0});
  const SpeedChange down = planSpeedChange(-3.0, -2.0, {-50.0, 4.0, 5.0, 0.0});
  ASSERT_EQ(up.count, down.count);
  for (std::size_t k = 0; k < up.count; ++k) {
    EXPECT_EQ(up.segments[k].duration, down.segments[k].duration);
    EXPECT_EQ(up.segments[k].speed, -down.segments[k].speed);
    EXPECT_EQ(up.segments[k].acceleration, -down.segments[k].acceleration);
  }
}

TEST(SpeedMove, FaultsAreFound) {
  const double nan = std::numeric_limits<double>::quiet_NaN();
  const double infinity = std::numeric_limits<double>::infinity();
  EXPECT_FALSE(faultOf({300.0, 20.0, 200.0, 5.0}));
  EXPECT_FALSE(faultOf({-300.0, 20.0, 0.0, 0.0}));
  for (const double bad : {nan, infinity, -infinity, 2e6}) {
    EXPECT_TRUE(faultOf({bad, 20.0, 200.0, 5.0})) << bad;
  }
  for (const double bad : {nan, infinity, 0.0, -1.0}) {
    EXPECT_TRUE(faultOf({1.0, bad, 200.0, 5.0})) << bad;
  }
  for (const double bad : {nan, infinity, -1.0}) {
    EXPECT_TRUE(faultOf({1.0, 20.0, bad, 5.0})) << bad;
    EXPECT_TRUE(faultOf({1.0, 20.0, 200.0, bad})) << bad;
  }
}

}  // namespace speed_profile_test
}  // namespace whirl_twin

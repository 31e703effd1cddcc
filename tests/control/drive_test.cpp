// A drive's motion is continuous, stays within its limits, completes its moves in time, and accepts
// a new target speed at any instant.
#include "control/drive.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>
#include <random>
#include <string>
#include <tuple>
#include <vector>

#include "messages/input_error.h"

namespace whirl_twin {
namespace drive_test {

constexpr std::int64_t kSecond = 1000000000;

// Smallest distance between two angles [rad] on the circle.
double apart(double a, double b) {
  return std::abs(std::remainder(a - b, 2.0 * M_PI));
}

double seconds(std::int64_t nanoseconds) {
  return static_cast<double>(nanoseconds) / 1e9;
}

const std::vector<SpeedMove> kUpAndDown{
    {300.0, 20.0, 200.0, 5.0}, {300.0, 20.0, 200.0, 1.0}, {-50.0, 100.0, 0.0, 2.0}};

TEST(Drive, AtAnOffsetIsTheMotionOfTheStepThatBeginsThere) {
  const Drive drive(0.0, 1.0, kUpAndDown);
  std::mt19937_64 random(6);
  std::uniform_int_distribution<std::int64_t> time(0, 30 * kSecond);
  // Steps of a millisecond, and of ten seconds that jump over several pieces.
  for (const std::int64_t longest : {kSecond / 1000, 10 * kSecond, 40 * kSecond}) {
    for (int i = 0; i < 3000; ++i) {
      const std::int64_t t = time(random);
      const std::int64_t h = std::uniform_int_distribution<std::int64_t>(0, longest)(random);
      Drive here = drive;
      Drive there = drive;
      here.begin(t);
      there.begin(t + h);
      const ShaftMotion reached = here.at(seconds(h));
      const ShaftMotion begun = there.at(0.0);
      // The offset, and angles of up to 300 rad/s times the step, are rounded to doubles.
      const double rounding = 4.0 * 2.3e-16;
      ASSERT_LT(apart(reached.angle, begun.angle), rounding * (7.0 + 300.0 * seconds(h))) << t;
      ASSERT_NEAR(reached.speed, begun.speed, 1e-12) << t << " + " << h;
      ASSERT_NEAR(reached.acceleration, begun.acceleration, 1e-11) << t << " + " << h;
      ASSERT_EQ(reached.jerk, begun.jerk) << t << " + " << h;
      const ShaftMotion without = here.withoutAngle(seconds(h));
      ASSERT_EQ(std::tuple(without.angle, without.speed, without.acceleration, without.jerk),
                std::tuple(0.0, reached.speed, reached.acceleration, reached.jerk));
      // The angle counts on from the remainder at the step's start, without a jump of 2 pi.
      ASSERT_NEAR(reached.angle,
                  here.angle().remainder + there.angle().total() - here.angle().total(), 1e-10);
    }
  }
}

TEST(Drive, GoesThroughItsMovesInTime) {
  Drive drive(0.0, 0.0, kUpAndDown);
  // 15.1 s up, then dwells of 5 s and 1 s, for the second move changes nothing.
  drive.begin(10 * kSecond);
  EXPECT_EQ(drive.targetSpeed(), 300.0);
  EXPECT_FALSE(drive.constantFor(1e-3));
  EXPECT_DOUBLE_EQ(drive.at(0.0).acceleration, 20.0);
  drive.begin(15100000001);
  EXPECT_EQ(drive.at(0.0).speed, 300.0);
  EXPECT_TRUE(drive.constantFor(5.9));
  EXPECT_FALSE(drive.constantFor(6.1));
  // 3.5 s down at a constant acceleration.
  drive.begin(22 * kSecond);
  EXPECT_EQ(drive.targetSpeed(), -50.0);
  EXPECT_DOUBLE_EQ(drive.at(0.0).acceleration, -100.0);
  EXPECT_NEAR(drive.at(0.0).speed, 300.0 - 0.9 * 100.0, 1e-12);
  drive.begin(1000 * kSecond);
  EXPECT_EQ(drive.at(0.0).speed, -50.0);
  EXPECT_TRUE(drive.constantFor(1e9));
}

TEST(Drive, AtConstantSpeedTurnsSteadily) {
  Drive drive(10.0, -1.0);
  EXPECT_TRUE(drive.constantFor(std::numeric_limits<double>::infinity()));
  EXPECT_EQ(drive.targetSpeed(), 10.0);
  drive.begin(3 * kSecond);
  EXPECT_NEAR(drive.angle().total(), 29.0, 1e-14);
  const ShaftMotion motion = drive.at(0.5);
  EXPECT_LT(apart(motion.angle, 34.0), 1e-14);
  EXPECT_EQ(motion.speed, 10.0);
  EXPECT_EQ(motion.acceleration, 0.0);
}

TEST(Drive, StartsItsProfileAtTheTimeGiven) {
  const std::int64_t start = 123456789012345;
  Drive from_zero(0.0, 1.0, kUpAndDown);
  Drive later(0.0, 1.0, kUpAndDown, start);
  for (std::int64_t t = 0; t < 40 * kSecond; t += 377777777) {
    from_zero.begin(t);
    later.begin(start + t);
    EXPECT_EQ(from_zero.angle().turns, later.angle().turns);
    EXPECT_EQ(from_zero.angle().remainder, later.angle().remainder);
    EXPECT_EQ(from_zero.at(0.0).speed, later.at(0.0).speed);
  }
}

TEST(Drive, TellsAnotherPieceFromTheSame) {
  Drive drive(0.0, 0.0, {{30.0, 20.0, 0.0, 2.0}, {60.0, 20.0, 0.0, 0.0}});
  drive.begin(2 * kSecond);
  const std::uint64_t steady = drive.piece();
  drive.begin(3 * kSecond);
  EXPECT_EQ(drive.nanoseconds(), 3 * kSecond);
  EXPECT_EQ(drive.piece(), steady) << "30 rad/s from 1.5 s to 3.5 s";
  drive.begin(6 * kSecond);
  const std::uint64_t last = drive.piece();
  EXPECT_NE(last, steady);
  drive.begin(2 * kSecond);
  EXPECT_NE(drive.piece(), last);
  drive.begin(6 * kSecond);
  const std::uint64_t before = drive.piece();
  ASSERT_TRUE(drive.setSpeed(60.0, 1.0, 0.0));
  EXPECT_NE(drive.piece(), before) << "a new order, though to the same speed";
}

TEST(Drive, GoesBackToTheStartWhenTimeDoes) {
  Drive drive(0.0, 1.0, kUpAndDown);
  drive.begin(100 * kSecond);
  drive.begin(0);
  EXPECT_EQ(drive.angle().turns, 0);
  EXPECT_EQ(drive.angle().remainder, 1.0);
  EXPECT_EQ(drive.at(0.0).speed, 0.0);
  EXPECT_EQ(drive.at(0.0).jerk, 200.0);
}

TEST(Drive, SetSpeedFromAnyInstantIsContinuousAndKeepsWithinItsLimits) {
  std::mt19937_64 random(7);
  std::uniform_real_distribution<double> unit(-1.0, 1.0);
  std::uniform_real_distribution<double> decade(0.0, 3.0);
  std::uniform_real_distribution<double> moment(0.0, 1.2);
  Drive drive(0.0, 0.0);
  std::int64_t now = 0;
  for (int i = 0; i < 500; ++i) {
    const ShaftMotion before = drive.at(0.0);
    const ShaftAngle angle_before = drive.angle();
    const double speed = 500.0 * unit(random);
    const double limit = std::pow(10.0, decade(random));
    const double jerk = std::pow(10.0, decade(random));
    ASSERT_TRUE(drive.setSpeed(speed, limit, jerk));
    const double duration = drive.moveDuration();
    ASSERT_EQ(drive.targetSpeed(), speed);

    const ShaftMotion after = drive.at(0.0);
    ASSERT_EQ(after.angle, before.angle);
    ASSERT_EQ(after.speed, before.speed);
    ASSERT_EQ(after.acceleration, before.acceleration);
    ASSERT_EQ(drive.angle().turns, angle_before.turns);

    // Along the move: limits, and speed and angle that change by no more than they may.
    const double allowed = std::max(limit, std::abs(before.acceleration));
    const double fastest =
        std::max({std::abs(before.speed), std::abs(speed),
                  std::abs(stoppingSpeed(before.speed, before.acceleration, jerk))});
    const int samples = 400;
    const double h = 1.05 * duration / samples;
    // Roundings of the speeds (one in 1e16 of those that enter) and of offsets from begin().
    const double speed_rounding = 1e-14 * (fastest + allowed * allowed / jerk);
    ShaftMotion last = after;
    double turned = 0.0;
    for (int k = 1; k <= samples; ++k) {
      const ShaftMotion motion = drive.at(h * k);
      ASSERT_LE(std::abs(motion.acceleration), allowed * (1.0 + 1e-12));
      ASSERT_LE(std::abs(motion.jerk), jerk);
      ASSERT_LE(std::abs(motion.speed), fastest + speed_rounding);
      ASSERT_LE(std::abs(motion.acceleration - last.acceleration),
                jerk * h * (1.0 + 1e-9) + 1e-12 * allowed);
      ASSERT_LE(std::abs(motion.speed - last.speed), allowed * h * (1.0 + 1e-9) + speed_rounding);
      // Simpson's rule for the angle: exact within a piece.
      turned += h / 6.0 * (last.speed + 4.0 * drive.at(h * (k - 0.5)).speed + motion.speed);
      last = motion;
    }
    ASSERT_EQ(last.speed, speed);
    ASSERT_EQ(last.acceleration, 0.0);
    // Simpson errs by at most jerk h^3 / 6 in each of the three steps where the jerk changes.
    ASSERT_NEAR(last.angle - after.angle, turned,
                0.5 * jerk * h * h * h + 1e-12 * (1.0 + std::abs(fastest) * duration));

    const auto end = now + static_cast<std::int64_t>(std::ceil(duration * 1e9));
    Drive finished = drive;
    finished.begin(end + 1);
    ASSERT_EQ(finished.at(0.0).speed, speed);
    ASSERT_TRUE(finished.constantFor(1e6));

    // The next order comes mostly in the middle of this move.
    now += static_cast<std::int64_t>(moment(random) * duration * 1e9);
    drive.begin(now);
  }
}

TEST(Drive, SetSpeedReplacesTheRestOfTheProfile) {
  Drive drive(0.0, 0.0, kUpAndDown);
  drive.begin(5 * kSecond);
  ASSERT_TRUE(drive.setSpeed(0.0, 50.0, 0.0));
  EXPECT_NEAR(drive.moveDuration(), 99.0 / 50.0, 1e-13);
  drive.begin(7 * kSecond);
  EXPECT_EQ(drive.at(0.0).speed, 0.0);
  const ShaftAngle rest = drive.angle();
  drive.begin(30 * kSecond);
  EXPECT_EQ(drive.at(0.0).speed, 0.0);
  EXPECT_EQ(drive.angle().turns, rest.turns);
  EXPECT_EQ(drive.angle().remainder, rest.remainder);
}

TEST(Drive, SetSpeedToThePresentSpeedChangesNothing) {
  Drive drive(40.0, 0.0);
  drive.begin(kSecond);
  ASSERT_TRUE(drive.setSpeed(40.0, 1.0, 1.0));
  EXPECT_EQ(drive.moveDuration(), 0.0);
  EXPECT_TRUE(drive.constantFor(1e9));
  drive.begin(2 * kSecond);
  EXPECT_NEAR(drive.angle().total(), 80.0, 1e-13);
}

TEST(Drive, SetSpeedRefusesBadArgumentsAndGoesOn) {
  const double nan = std::numeric_limits<double>::quiet_NaN();
  Drive drive(0.0, 0.0, kUpAndDown);
  drive.begin(5 * kSecond);
  EXPECT_FALSE(drive.setSpeed(nan, 1.0, 1.0));
  EXPECT_FALSE(drive.setSpeed(1e7, 1.0, 1.0));
  EXPECT_FALSE(drive.setSpeed(1.0, 0.0, 1.0));
  EXPECT_FALSE(drive.setSpeed(1.0, nan, 1.0));
  EXPECT_FALSE(drive.setSpeed(1.0, 1.0, -1.0));
  EXPECT_FALSE(drive.setSpeed(1.0, 1e-9, 1.0)) << "would last three thousand years";
  EXPECT_FALSE(drive.setSpeed(1.0, 1.0, 1e-6)) << "would run through 2e8 rad/s";
  EXPECT_EQ(drive.targetSpeed(), 300.0);
  EXPECT_EQ(drive.moveDuration(), 0.0);
  EXPECT_DOUBLE_EQ(drive.at(0.0).acceleration, 20.0);
}

TEST(Drive, ResetBringsTheProfileBack) {
  Drive drive(0.0, 1.0, kUpAndDown, kSecond);
  const Drive fresh = drive;
  drive.begin(9 * kSecond);
  ASSERT_TRUE(drive.setSpeed(-100.0, 30.0, 50.0));
  drive.begin(12 * kSecond);
  drive.reset();
  EXPECT_EQ(drive.moveDuration(), 0.0);
  EXPECT_EQ(drive.angle().remainder, 1.0);
  Drive reference = fresh;
  for (const std::int64_t t : {kSecond, 9 * kSecond, 40 * kSecond}) {
    drive.begin(t);
    reference.begin(t);
    EXPECT_EQ(drive.angle().turns, reference.angle().turns);
    EXPECT_EQ(drive.angle().remainder, reference.angle().remainder);
    EXPECT_EQ(drive.targetSpeed(), reference.targetSpeed());
  }
}

TEST(Drive, ResetForgetsAnOrderGivenAtTheFirstInstant) {
  Drive drive(10.0, 1.0);
  ASSERT_TRUE(drive.setSpeed(-10.0, 1.0, 0.0));
  drive.reset();
  drive.begin(kSecond);
  EXPECT_NEAR(drive.angle().total(), 11.0, 1e-14);
  EXPECT_EQ(drive.at(0.0).speed, 10.0);
  EXPECT_EQ(drive.at(0.0).acceleration, 0.0);
  EXPECT_TRUE(drive.constantFor(1e9));
}

TEST(Drive, CopiesAreIndependent) {
  Drive drive(0.0, 0.0, kUpAndDown);
  drive.begin(5 * kSecond);
  ASSERT_TRUE(drive.setSpeed(10.0, 30.0, 50.0));
  Drive copy = drive;
  ASSERT_TRUE(drive.setSpeed(-10.0, 30.0, 50.0));
  copy.begin(20 * kSecond);
  drive.begin(20 * kSecond);
  EXPECT_EQ(copy.at(0.0).speed, 10.0);
  EXPECT_EQ(drive.at(0.0).speed, -10.0);
}

// 5^2 / (2 * 2) = 6.25 rad/s of run-up before the band from 54 to 66 rad/s, and as much beyond it.
TEST(Drive, GoesBackAndBeyondToCrossABandAtFullAcceleration) {
  const ExclusionBands avoid({{54, 66}});
  Drive drive(54.0, 0.0, {{66.0, 5.0, 2.0, 1.0}}, 0, avoid);
  const auto [lowest, highest] = drive.speedRange();
  EXPECT_NEAR(lowest, 54.0 - 6.25, 1e-12);
  EXPECT_NEAR(highest, 66.0 + 6.25, 1e-12);
  EXPECT_EQ(drive.targetSpeed(), 66.0) << "also while it goes back";
  int crossing = 0;
  double before = 54.0;
  for (std::int64_t ms = 0; ms < 30000; ++ms) {
    drive.begin(ms * kSecond / 1000);
    const ShaftMotion motion = drive.at(0.0);
    EXPECT_NEAR(motion.speed, before, 5.0 / 1000.0 + 1e-12) << ms;
    before = motion.speed;
    if (motion.speed > 54.0 + 1e-9 && motion.speed < 66.0 - 1e-9) {
      ASSERT_NEAR(motion.acceleration, 5.0, 1e-12) << ms << " ms, " << motion.speed << " rad/s";
      ++crossing;
    }
  }
  EXPECT_NEAR(crossing, 2400, 1) << "12 rad/s at 5 rad/s^2";
  EXPECT_EQ(before, 66.0);
}

TEST(Drive, SentIntoABandGoesToItsEdge) {
  Drive drive(0.0, 0.0, {}, 0, ExclusionBands({{54, 66}}));
  ASSERT_TRUE(drive.setSpeed(61.0, 5.0, 2.0));
  EXPECT_EQ(drive.targetSpeed(), 66.0);
  drive.begin(100 * kSecond);
  EXPECT_EQ(drive.at(0.0).speed, 66.0);
  ASSERT_TRUE(drive.setSpeed(59.5, 5.0, 2.0));
  EXPECT_EQ(drive.targetSpeed(), 66.0) << "by the hysteresis";
  ASSERT_TRUE(drive.setSpeed(56.0, 5.0, 2.0));
  EXPECT_EQ(drive.targetSpeed(), 54.0);
}

// In the middle of a band, on its way up: it continues, and returns at full acceleration.
TEST(Drive, StopsPastItsBands) {
  Drive drive(0.0, 0.0, {{100.0, 5.0, 2.0, 0.0}}, 0, ExclusionBands({{54, 66}}));
  std::int64_t ms = 0;
  for (drive.begin(0); drive.at(0.0).speed < 60.0; drive.begin(++ms * kSecond / 1000)) {
  }
  ASSERT_TRUE(drive.setSpeed(0.0, 5.0, 2.0));
  EXPECT_EQ(drive.targetSpeed(), 0.0);
  double highest = 0.0;
  for (const std::int64_t start = ms; drive.at(0.0).speed > 0.0; ++ms) {
    ASSERT_LT(ms, start + 60000);
    drive.begin(ms * kSecond / 1000);
    const ShaftMotion motion = drive.at(0.0);
    highest = std::max(highest, motion.speed);
    if (motion.speed > 54.0 + 1e-9 && motion.speed < 66.0 - 1e-9) {
      ASSERT_NEAR(std::abs(motion.acceleration), 5.0, 1e-12) << motion.speed;
    }
  }
  EXPECT_NEAR(highest, 66.0 + 6.25, 1e-5);
}

TEST(Drive, BadProfilesAreNamed) {
  const auto message = [](double speed, double angle, const std::vector<SpeedMove>& moves) {
    try {
      const Drive drive(speed, angle, moves);
    } catch (const InputError& error) {
      return std::string(error.what());
    }
    return std::string();
  };
  EXPECT_EQ(message(0.0, 0.0, {{1.0, 1.0, 0.0, 0.0}, {2.0, -3.0, 0.0, 0.0}}),
            "drive: profile move 2: max_acceleration must be positive and finite, in rad/s^2, "
            "found -3");
  EXPECT_EQ(message(2e6, 0.0, {}), "drive: speed must be within +-1e6 rad/s, found 2000000");
  EXPECT_NE(message(0.0, NAN, {}).find("angle"), std::string::npos);
  EXPECT_NE(message(0.0, 0.0, {{1e5, 1e-5, 0.0, 0.0}}).find("at most 1e9 s"), std::string::npos);
  EXPECT_THROW(Drive(0.0, 0.0, {{60.0, 1.0, 0.0, 0.0}}, 0, ExclusionBands({{54, 66}})), InputError);
}

}  // namespace drive_test
}  // namespace whirl_twin

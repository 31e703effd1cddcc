// The phase of a shaft is as accurate after months as after a second, against a reference of 100
// decimal digits.
#include "control/shaft_angle.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <boost/math/constants/constants.hpp>
#include <boost/multiprecision/cpp_bin_float.hpp>
#include <cmath>
#include <cstdint>
#include <limits>
#include <random>

namespace whirl_twin {
namespace shaft_angle_test {

using Exact = boost::multiprecision::cpp_bin_float_100;

const Exact kTwoPi = boost::math::constants::two_pi<Exact>();

// The error bound in the header is 3e-15 rad for one call.
constexpr double kPromised = 3e-15;

double error(const ShaftAngle& angle, const Exact& expected) {
  return static_cast<double>(kTwoPi * angle.turns + Exact(angle.remainder) - expected);
}

bool remainderInRange(const ShaftAngle& angle) {
  return angle.remainder >= 0.0 && angle.remainder < 2.0 * M_PI;
}

TEST(ShaftAngle, ConstantSpeedIsExactForSpeedsAndDurationsOfAnySize) {
  std::mt19937_64 random(1);
  std::uniform_real_distribution<double> exponent(-3.0, 5.0);
  std::uniform_real_distribution<double> digits(0.0, 16.0);
  std::uniform_real_distribution<double> start(-1e3, 1e3);
  for (int i = 0; i < 20000; ++i) {
    const double sign = i % 2 == 0 ? 1.0 : -1.0;
    const double speed = sign * std::pow(10.0, exponent(random));
    const auto nanoseconds =
        static_cast<std::int64_t>(std::pow(10.0, digits(random))) * (i % 3 == 0 ? -1 : 1);
    const ShaftAngle from = shaftAngle(start(random));
    const ShaftAngle to = advance(from, speed, nanoseconds);
    const Exact expected = kTwoPi * from.turns + Exact(from.remainder) +
                           Exact(speed) * Exact(nanoseconds) / Exact(1000000000);
    ASSERT_LT(std::abs(error(to, expected)), kPromised) << speed << " rad/s, " << nanoseconds;
    ASSERT_TRUE(remainderInRange(to)) << to.remainder;
  }
}

// 250 years, the largest time a drive accepts.
constexpr std::int64_t kLongest = 8000000000000000000;

TEST(SplitAngle, HoldsATurnToTwiceTheDigitsOfADouble) {
  std::mt19937_64 random(8);
  std::uniform_real_distribution<double> exponent(-3.0, 5.0);
  std::uniform_real_distribution<double> digits(0.0, 12.0);
  for (int i = 0; i < 20000; ++i) {
    const double speed = (i % 2 == 0 ? 1.0 : -1.0) * std::pow(10.0, exponent(random));
    const auto nanoseconds = static_cast<std::int64_t>(std::pow(10.0, digits(random)));
    const SplitAngle turn = turnIn(speed, nanoseconds);
    const Exact turned = Exact(speed) * Exact(nanoseconds) / Exact(1000000000);
    const Exact off = Exact(turn.high) + Exact(turn.low) - turned;
    const Exact error = off - kTwoPi * boost::multiprecision::round(off / kTwoPi);
    const double bound = 0x1p-103 * (std::fabs(static_cast<double>(turned)) + 1.0) +
                         0x1p-124 * static_cast<double>(nanoseconds);
    ASSERT_LT(std::fabs(static_cast<double>(error)), bound) << speed << ", " << nanoseconds;
    ASSERT_LE(std::fabs(turn.high), M_PI);
    ASSERT_LE(std::fabs(turn.low), 0x1p-53 * std::fabs(turn.high));
  }
}

TEST(SteadyTurn, IsExactFor250YearsForwardsAndBackwards) {
  std::mt19937_64 random(8);
  std::uniform_real_distribution<double> digits(0.0, 18.9);
  std::uniform_real_distribution<double> decade(-12.0, 5.0);
  std::uniform_real_distribution<double> unit(0.0, 1.0);
  for (int i = 0; i < 50000; ++i) {
    const double size = i % 2 == 0 ? 1e5 * unit(random) : std::pow(10.0, decade(random));
    const double speed = i % 4 < 2 ? size : -size;
    const double lead = i % 5 == 0 ? 0.0 : 1e-9 * unit(random);
    const auto count =
        std::min(kLongest, static_cast<std::int64_t>(std::pow(10.0, digits(random))));
    const std::int64_t nanoseconds = i % 3 == 0 ? -count : count;
    const ShaftAngle from{i - 25000, i % 7 == 0 ? 0.0 : 2.0 * M_PI * unit(random)};
    const ShaftAngle to = SteadyTurn(from, speed, lead).at(nanoseconds);

    const Exact expected = kTwoPi * from.turns + Exact(from.remainder) +
                           Exact(speed) * (Exact(nanoseconds) / Exact(1000000000) + Exact(lead));
    // The error bound in the header is 2.5e-15 rad. From zero the sum with the start is exact:
    // 1.1e-15 rad.
    const double promised = from.remainder == 0.0 ? 1.1e-15 : 2.5e-15;
    ASSERT_LT(std::abs(error(to, expected)), promised) << speed << " rad/s, " << nanoseconds;
    ASSERT_TRUE(remainderInRange(to)) << to.remainder;

    // The double-double route has an error bound of 3e-15 rad, and shares no arithmetic with this
    // one.
    const ShaftAngle other = advance(from, speed, 0.0, 0.0, later(splitTime(nanoseconds), lead));
    ASSERT_LT(std::abs(static_cast<double>(to.turns - other.turns) * 2.0 * M_PI +
                       (to.remainder - other.remainder)),
              5.5e-15)
        << speed << " rad/s, " << nanoseconds;
  }
}

TEST(SteadyTurn, StartsAtItsAngleToTheLastBit) {
  for (const double remainder : {0.0, 1e-300, 0.25, std::nextafter(2.0 * M_PI, 0.0)}) {
    for (const double speed : {-1e5, -1e-300, 0.0, 314.159, 1e6}) {
      const ShaftAngle at = SteadyTurn({-3, remainder}, speed, 0.0).at(0);
      EXPECT_EQ(at.turns, -3);
      EXPECT_EQ(at.remainder, remainder);
    }
  }
}

TEST(SteadyTurn, StaysWithinOneTurnAtTheEndOfEachTurn) {
  // 1000 turns/s within an ulp or two: every millisecond the phase is just beside a whole turn.
  const double speed = 2000.0 * M_PI;
  for (const double near : {std::nextafter(speed, 0.0), speed, std::nextafter(speed, 1e9)}) {
    for (const double start : {0.0, 1e-16, std::nextafter(2.0 * M_PI, 0.0)}) {
      for (const double direction : {-1.0, 1.0}) {
        const SteadyTurn turn({0, start}, direction * near, 0.0);
        for (std::int64_t k = -1000; k <= 1000; ++k) {
          const ShaftAngle at = turn.at(k * 1000000);
          ASSERT_TRUE(remainderInRange(at)) << at.remainder;
          const Exact expected = Exact(start) + Exact(direction * near) * k / 1000;
          ASSERT_LT(std::abs(error(at, expected)), 2.5e-15) << k;
        }
      }
    }
  }
}

TEST(ShaftAngle, ConstantJerkIsExactOverHours) {
  std::mt19937_64 random(2);
  std::uniform_real_distribution<double> unit(-1.0, 1.0);
  for (int i = 0; i < 5000; ++i) {
    const double speed = 1e5 * unit(random);
    const double acceleration = 20.0 * unit(random);
    const double jerk = 2e-3 * unit(random);
    const auto nanoseconds = static_cast<std::int64_t>(2e13 * std::abs(unit(random)));
    const Exact time = Exact(nanoseconds) / Exact(1000000000);
    const Exact expected =
        time * (Exact(speed) + time * (Exact(acceleration) / 2 + time * Exact(jerk) / 6));
    const ShaftAngle to = advance({}, speed, acceleration, jerk, splitTime(nanoseconds));
    ASSERT_LT(std::abs(error(to, expected)), kPromised) << nanoseconds;
    ASSERT_TRUE(remainderInRange(to)) << to.remainder;
  }
}

TEST(ShaftAngle, ManySmallAdvancesAddUpToOneLargeOne) {
  ShaftAngle stepped;
  for (int i = 0; i < 1000; ++i) {
    stepped = advance(stepped, 314.159, 1000003);
  }
  const ShaftAngle once = advance({}, 314.159, 1000003000);
  EXPECT_EQ(stepped.turns, once.turns);
  // A thousand roundings of up to the error bound each.
  EXPECT_NEAR(stepped.remainder, once.remainder, 1000 * kPromised);
}

TEST(ShaftAngle, TurningBackReturnsToTheStart) {
  const ShaftAngle start = shaftAngle(1.0);
  const std::int64_t month = 2592000000000000;
  const ShaftAngle back = advance(advance(start, 1e5, month), -1e5, month);
  EXPECT_EQ(back.turns, 0);
  EXPECT_NEAR(back.remainder, 1.0, 2 * kPromised);
}

TEST(ShaftAngle, NegativeAnglesHaveAPositiveRemainder) {
  const ShaftAngle quarter_back = shaftAngle(-M_PI / 2);
  EXPECT_EQ(quarter_back.turns, -1);
  EXPECT_NEAR(quarter_back.remainder, 1.5 * M_PI, kPromised);
  EXPECT_NEAR(quarter_back.total(), -M_PI / 2, kPromised);
}

TEST(ShaftAngle, WholeTurnsLeaveNoRemainderOutsideTheRange) {
  for (int turns = -50; turns <= 50; ++turns) {
    const double angle = turns * 2.0 * M_PI;
    for (const double near : {std::nextafter(angle, -1e9), angle, std::nextafter(angle, 1e9)}) {
      EXPECT_TRUE(remainderInRange(shaftAngle(near))) << near;
      EXPECT_LT(std::abs(error(shaftAngle(near), Exact(near))), kPromised) << near;
    }
  }
  EXPECT_TRUE(remainderInRange(shaftAngle(-1e-300)));
}

TEST(ShaftAngle, StaysWhereItIsWhereTurnsCannotBeCounted) {
  const ShaftAngle start{7, 1.5};
  const auto expectStart = [&](const ShaftAngle& angle) {
    EXPECT_EQ(angle.turns, start.turns);
    EXPECT_EQ(angle.remainder, start.remainder);
  };
  for (const double far : {1e18, -1e18, 1e300, -1e300, std::numeric_limits<double>::infinity(),
                           std::numeric_limits<double>::quiet_NaN()}) {
    EXPECT_EQ(shaftAngle(far).turns, 0);
    EXPECT_EQ(shaftAngle(far).remainder, 0.0);
    expectStart(advance(start, far, 0.0, 0.0, {1.0, 0.0}));
    expectStart(advance(start, 0.0, far, 0.0, {3.0, 0.0}));
    expectStart(advance(start, 0.0, 0.0, far, {3.0, 0.0}));
    expectStart(advance(start, far, std::int64_t{1000000000}));
    EXPECT_EQ(turnIn(far, 1000000).high, 0.0);
  }
}

TEST(ShaftAngle, TotalIsTheRoundedAngle) {
  const double angle = 1.23456789e6;
  EXPECT_DOUBLE_EQ(shaftAngle(angle).total(), angle);
  EXPECT_DOUBLE_EQ(shaftAngle(-angle).total(), -angle);
}

TEST(SplitTime, ResolvesNanosecondsAfterAYear) {
  const std::int64_t year = 31557600000000001;
  const SplitTime time = splitTime(year);
  const Exact exact = Exact(year) / Exact(1000000000);
  // A relative 2^-104 of 3e7 s.
  EXPECT_LT(std::abs(static_cast<double>(Exact(time.high) + Exact(time.low) - exact)), 2e-24);
  const SplitTime half_later = later(time, 0.5e-9);
  EXPECT_LT(std::abs(static_cast<double>(Exact(half_later.high) + Exact(half_later.low) - exact -
                                         Exact(0.5e-9))),
            2e-24);
}

}  // namespace shaft_angle_test
}  // namespace whirl_twin

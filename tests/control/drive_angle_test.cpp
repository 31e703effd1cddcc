// The angle of a drive against references that share none of its arithmetic: 100 decimal digits
// over the pieces of its profile, and quadrature of the acceleration in long double.
#include <gtest/gtest.h>

#include <algorithm>
#include <boost/math/constants/constants.hpp>
#include <boost/multiprecision/cpp_bin_float.hpp>
#include <cmath>
#include <cstdint>
#include <limits>
#include <random>
#include <vector>

#include "control/drive.h"

namespace whirl_twin {
namespace drive_angle_test {

using Exact = boost::multiprecision::cpp_bin_float_100;

const Exact kTwoPi = boost::math::constants::two_pi<Exact>();

double error(const ShaftAngle& angle, const Exact& expected) {
  return static_cast<double>(kTwoPi * angle.turns + Exact(angle.remainder) - expected);
}

// The same moves summed piece by piece in 100 digits.
class ExactProfile {
 public:
  ExactProfile(double speed, double angle, const std::vector<SpeedMove>& moves) : angle_(angle) {
    for (const SpeedMove& move : moves) {
      const SpeedChange change = planSpeedChange(speed, 0.0, move);
      pieces_.insert(pieces_.end(), change.segments.begin(),
                     change.segments.begin() + static_cast<std::ptrdiff_t>(change.count));
      pieces_.push_back({move.dwell, move.speed, 0.0, 0.0});
      speed = move.speed;
    }
    pieces_.push_back({1e300, speed, 0.0, 0.0});
  }

  Exact angleAt(std::int64_t nanoseconds) const {
    Exact left = Exact(nanoseconds) / Exact(1000000000);
    Exact angle = angle_;
    for (const SpeedSegment& piece : pieces_) {
      const Exact t = left < Exact(piece.duration) ? left : Exact(piece.duration);
      angle += t * (Exact(piece.speed) +
                    t * (Exact(piece.acceleration) / 2 + t * Exact(piece.jerk) / 6));
      left -= t;
    }
    return angle;
  }

 private:
  double angle_;
  std::vector<SpeedSegment> pieces_;
};

TEST(DriveAngle, LosesNoPhaseInABillionSteps) {
  const double speed = 314.159;
  const std::int64_t step = 1000000;
  Drive drive(speed, 0.25);
  for (const std::int64_t count : {1LL, 1000LL, 1000000LL, 999999999LL, 1000000000LL}) {
    drive.begin(count * step);
    const Exact expected = Exact(0.25) + Exact(speed) * Exact(count) / 1000;
    EXPECT_LT(std::abs(error(drive.angle(), expected)), 3e-15) << count;
    const ShaftAngle once = advance(shaftAngle(0.25), speed, count * step);
    EXPECT_EQ(drive.angle().turns, once.turns);
    EXPECT_EQ(drive.angle().remainder, once.remainder);
  }
}

TEST(DriveAngle, LosesNoPhaseInRampsOfHours) {
  // 1e5 rad/s after five and a half hours of finite jerk, a day of dwell, and down again.
  const std::vector<SpeedMove> moves{{1e5, 10.0, 1e-3, 86400.5}, {-2e4, 20.0, 3e-3, 1.0 / 3.0}};
  const ExactProfile exact(123.4, 1.0, moves);
  Drive drive(123.4, 1.0, moves);
  std::mt19937_64 random(4);
  std::uniform_int_distribution<std::int64_t> time(0, 150000000000000);
  std::vector<std::int64_t> times(2000);
  std::generate(times.begin(), times.end(), [&] { return time(random); });
  std::sort(times.begin(), times.end());
  for (const std::int64_t t : times) {
    drive.begin(t);
    // At most seven pieces have been passed, at 3e-15 rad each.
    ASSERT_LT(std::abs(error(drive.angle(), exact.angleAt(t))), 7 * 3e-15) << t;
  }
}

TEST(DriveAngle, RandomProfilesAgreeWithTheExactOnes) {
  std::mt19937_64 random(5);
  std::uniform_real_distribution<double> unit(-1.0, 1.0);
  std::uniform_real_distribution<double> decade(-1.0, 3.0);
  for (int i = 0; i < 100; ++i) {
    std::vector<SpeedMove> moves;
    for (int k = 0; k < 4; ++k) {
      const double jerk = k == i % 4 ? 0.0 : std::pow(10.0, decade(random));
      moves.push_back({1e3 * unit(random), std::pow(10.0, decade(random)), jerk,
                       std::max(0.0, 3.0 * unit(random))});
    }
    const double speed = 1e3 * unit(random);
    const std::int64_t start = static_cast<std::int64_t>(1e15 * unit(random));
    const ExactProfile exact(speed, -2.0, moves);
    Drive drive(speed, -2.0, moves, start);
    std::int64_t t = 0;
    for (int k = 0; k < 60; ++k) {
      drive.begin(start + t);
      // At most seventeen pieces, 3e-15 rad each.
      ASSERT_LT(std::abs(error(drive.angle(), exact.angleAt(t))), 17 * 3e-15) << i << ", " << t;
      t += static_cast<std::int64_t>(std::pow(10.0, 9.0 + 1.2 * unit(random)));
    }
  }
}

TEST(DriveAngle, IsTheSameInWhateverOrderTimesAreAskedFor) {
  // Dwells that start between two nanoseconds, between changes at finite and at unlimited jerk.
  const std::vector<SpeedMove> moves{
      {300.0, 20.0, 200.0, 1.0 / 3.0}, {-70.0, 90.0, 0.0, 2.0 / 7.0}, {1e4, 7e3, 1e4, 0.1}};
  Drive drive(11.0, 0.5, moves);
  const ExactProfile exact(11.0, 0.5, moves);
  std::mt19937_64 random(9);
  std::uniform_int_distribution<std::int64_t> time(0, 30000000000);
  for (int i = 0; i < 3000; ++i) {
    const std::int64_t t = time(random);
    drive.begin(t);
    Drive fresh(11.0, 0.5, moves);
    fresh.begin(t);
    ASSERT_EQ(drive.angle().turns, fresh.angle().turns) << t;
    ASSERT_EQ(drive.angle().remainder, fresh.angle().remainder) << t;
    ASSERT_EQ(drive.at(0.0).speed, fresh.at(0.0).speed) << t;
    ASSERT_EQ(drive.nextCorner(0.0), fresh.nextCorner(0.0)) << t;
    ASSERT_EQ(drive.targetSpeed(), fresh.targetSpeed()) << t;
    // At most ten pieces, 3e-15 rad each.
    ASSERT_LT(std::abs(error(drive.angle(), exact.angleAt(t))), 10 * 3e-15) << t;
  }
}

TEST(DriveAngle, ADwellIsContinuedBackwardsFor250Years) {
  // The first move changes nothing, so the profile begins with a dwell.
  const std::int64_t start = 1000000000000000000;
  Drive drive(-1e5, 2.0, {{-1e5, 1.0, 0.0, 2.5}, {0.0, 1e4, 0.0, 0.0}}, start);
  for (const std::int64_t t : {-8000000000000000000, -1234567890123456789, start - 1, start}) {
    drive.begin(t);
    const Exact before = (Exact(start) - Exact(t)) / Exact(1000000000);
    EXPECT_LT(std::abs(error(drive.angle(), Exact(2.0) + Exact(1e5) * before)), 3e-15) << t;
    EXPECT_EQ(drive.at(0.0).speed, -1e5);
    EXPECT_DOUBLE_EQ(drive.nextCorner(0.0), static_cast<double>(before + Exact(2.5)));
  }
}

TEST(DriveAngle, CornersAreAsExactAsTheClock) {
  Drive drive(0.0, 0.0, {{100.0, 50.0, 0.0, 0.3}, {0.0, 50.0, 0.0, 0.0}});
  for (const std::int64_t t : {0LL, 1LL, 1999999999LL, 2000000000LL, 2000000001LL, 2299999999LL}) {
    drive.begin(t);
    const double end = t < 2000000000 ? 2.0 : 2.3;
    const double left = static_cast<double>(Exact(end) - Exact(t) / Exact(1000000000));
    // An ulp of 2.3, which is a double here and 2 and 0.3 in the drive.
    EXPECT_NEAR(drive.nextCorner(0.0), left, 4.5e-16) << t;
  }
  drive.begin(5000000000);
  EXPECT_EQ(drive.nextCorner(0.0), std::numeric_limits<double>::infinity());
}

// Acceleration of a move from rest at zero to `speed`, straight from its definition.
long double acceleration(long double t, long double speed, long double limit, long double jerk) {
  const long double duration = speed / limit + limit / jerk;
  return std::max(0.0L, std::min({jerk * t, limit, jerk * (duration - t)}));
}

TEST(DriveAngle, IsTheTwofoldIntegralOfTheAcceleration) {
  const double speed = 300.0;
  const double limit = 20.0;
  const double jerk = 200.0;
  Drive drive(0.0, 0.0, {{speed, limit, jerk, 5.0}});
  const long double corners[] = {0.0L, 0.1L, 15.0L, 15.1L};
  const long double two_pi = boost::math::constants::two_pi<long double>();
  for (std::int64_t t = 0; t <= 18000000000; t += 50000000 + 12345) {
    const long double now = static_cast<long double>(t) / 1e9L;
    long double expected_speed = 0.0L;
    long double expected_angle = 0.0L;
    // theta = integral of (t - s) alpha(s) ds; Simpson's rule is exact for it between breakpoints.
    for (int k = 0; k < 3; ++k) {
      const long double a = std::min(now, corners[k]);
      const long double b = std::min(now, corners[k + 1]);
      for (const auto& [s, weight] :
           {std::pair{a, 1.0L}, std::pair{(a + b) / 2, 4.0L}, std::pair{b, 1.0L}}) {
        const long double part = weight * (b - a) / 6 * acceleration(s, speed, limit, jerk);
        expected_speed += part;
        expected_angle += part * (now - s);
      }
    }
    drive.begin(t);
    const ShaftMotion motion = drive.at(0.0);
    const ShaftAngle angle = drive.angle();
    // The durations 0.1 s and 14.9 s are rounded to doubles in the drive: at most 1e-15 s apart,
    // times 20 rad/s^2 for the speed and 300 rad/s for the angle, and a rounding of 300 rad/s.
    ASSERT_NEAR(motion.speed, static_cast<double>(expected_speed), 2e-13) << t;
    ASSERT_NEAR(static_cast<double>(two_pi * angle.turns + angle.remainder - expected_angle), 0.0,
                1e-12)
        << t;
    ASSERT_NEAR(motion.acceleration, static_cast<double>(acceleration(now, speed, limit, jerk)),
                1e-12)
        << t;
  }
}

}  // namespace drive_angle_test
}  // namespace whirl_twin

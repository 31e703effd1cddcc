// The force of a magnetic bearing: near the centre the data-sheet values, far from it the pull of
// its poles, limited to their maximum.
#include "mechanics/magnetic_bearing.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

namespace whirl_twin {
namespace magnetic_bearing_test {

constexpr double kKi = 100.0;    // N/A
constexpr double kBias = 2.0;    // A
constexpr double kGap = 4.0e-4;  // m
constexpr double kFull = 180.0;  // N
constexpr double kNone = std::numeric_limits<double>::infinity();
constexpr double kLaw = kKi * kGap * kGap / (4.0 * kBias);  // k of the two poles

TEST(MagneticBearing, IsNearTheMiddleWhatItsDataSheetSays) {
  const MagneticBearing magnet(kKi, kBias, kGap, kNone);
  EXPECT_DOUBLE_EQ(magnet.ks(), kKi * kBias / kGap);
  EXPECT_DOUBLE_EQ(magnet.ks(), 4.0 * kLaw * kBias * kBias / (kGap * kGap * kGap));
  const MagneticBearing::Force middle = magnet.axis(0.0, 0.0);
  EXPECT_EQ(middle.force, 0.0);
  EXPECT_DOUBLE_EQ(middle.by_current, kKi);
  EXPECT_DOUBLE_EQ(middle.by_place, magnet.ks());
  // The deviation from the linear law is of third order: the poles oppose each other.
  for (const double share : {1.0e-2, 1.0e-3}) {
    LocalState at;
    at.place = {share * kGap, -share * kGap};
    at.input = {-share * kBias, 0.0};
    NodalForce push;
    ASSERT_TRUE(magnet.push(at, push));
    EXPECT_LT(std::fabs(push.force[0]), 10.0 * share * share * share * kKi * kBias);
    EXPECT_LT(std::fabs(push.force[1]), 10.0 * share * share * share * kKi * kBias);
  }
}

TEST(MagneticBearing, PullsAsItsTwoPoles) {
  const MagneticBearing magnet(kKi, kBias, kGap, kNone);
  const auto pole = [](double current, double gap) { return kLaw * std::pow(current / gap, 2); };
  for (const double current : {-1.5, 0.0, 0.7}) {
    for (const double place : {-3.0e-4, 0.0, 1.0e-4}) {
      const MagneticBearing::Force f = magnet.axis(current, place);
      EXPECT_NEAR(f.force,
                  pole(kBias + current, kGap - place) - pole(kBias - current, kGap + place),
                  1e-12 * f.both);
      EXPECT_NEAR(magnet.axis(-current, -place).force, -f.force, 1e-12 * f.both);
      const double by = 1.0e-6;
      EXPECT_NEAR(
          f.by_current,
          (magnet.axis(current + by, place).force - magnet.axis(current - by, place).force) /
              (2.0 * by),
          1e-6 * kKi);
      const double aside = by * kGap;
      EXPECT_NEAR(
          f.by_place,
          (magnet.axis(current, place + aside).force - magnet.axis(current, place - aside).force) /
              (2.0 * aside),
          1e-6 * f.by_place);
    }
  }
  // Beyond the bias one pole is off, whatever the current.
  EXPECT_NEAR(magnet.axis(3.0, 1.0e-4).force, pole(5.0, 3.0e-4), 1e-9);
  EXPECT_NEAR(magnet.axis(-3.0, 1.0e-4).force, -pole(5.0, 5.0e-4), 1e-9);
}

TEST(MagneticBearing, TellsTheSlopesOfWhatItPushesWith) {
  const MagneticBearing magnet(kKi, kBias, kGap, kFull);
  constexpr double kPart = 1.0e-6;
  for (const double current : {-2.6, -0.4, 0.0, 0.8}) {  // beyond the bias, and saturated, too
    for (const double place : {-2.0e-4, 0.0, 1.0e-4}) {
      const LocalState at{{place, -0.5 * place}, {}, {current, 0.3 * current}, {}};
      const LocalSlopes slopes = magnet.slopes(at);
      for (std::size_t axis = 0; axis < 2; ++axis) {
        LocalState more = at, less = at;
        NodalForce up, down;
        more.place[axis] += kPart * kGap;
        less.place[axis] -= kPart * kGap;
        ASSERT_TRUE(magnet.push(more, up) && magnet.push(less, down));
        for (std::size_t i = 0; i < 2; ++i) {
          EXPECT_NEAR(slopes.stiffness(static_cast<int>(i), static_cast<int>(axis)),
                      -(up.force[i] - down.force[i]) / (2.0 * kPart * kGap), 1e-5 * magnet.ks());
        }
        more = less = at;
        more.input[axis] += kPart;
        less.input[axis] -= kPart;
        ASSERT_TRUE(magnet.push(more, up) && magnet.push(less, down));
        for (std::size_t i = 0; i < 2; ++i) {
          EXPECT_NEAR(slopes.by_input(static_cast<int>(i), static_cast<int>(axis)),
                      (up.force[i] - down.force[i]) / (2.0 * kPart), 1e-5 * kKi);
        }
      }
    }
  }
}

TEST(MagneticBearing, PullsNoMoreThanItsIronCarries) {
  const MagneticBearing magnet(kKi, kBias, kGap, kFull);
  EXPECT_EQ(magnet.axis(2.5, 0.0).force, kFull);
  EXPECT_EQ(magnet.axis(2.5, 0.0).by_current, 0.0);
  EXPECT_EQ(magnet.axis(-50.0, 0.0).force, -kFull);
  for (double current = -10.0; current <= 10.0; current += 0.1) {
    EXPECT_LE(std::fabs(magnet.axis(current, 2.0e-4).force), kFull);
  }
}

TEST(MagneticBearing, HasNoForceWhereItHasNoGap) {
  const MagneticBearing magnet(kKi, kBias, kGap, kFull);
  NodalForce push;
  LocalState at;
  at.place = {0.0, 0.999 * kGap};
  EXPECT_TRUE(magnet.push(at, push));
  for (const double place : {kGap, -kGap, 2.0 * kGap, std::nan("")}) {
    at.place = {0.0, place};
    EXPECT_FALSE(magnet.push(at, push)) << place;
  }
  EXPECT_DOUBLE_EQ(magnet.room({1.0e-4, -3.0e-4}), 1.0e-4);
}

}  // namespace magnetic_bearing_test
}  // namespace whirl_twin

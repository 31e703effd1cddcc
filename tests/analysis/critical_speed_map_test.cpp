// Critical speeds over the stiffness of the bearings, against a rigid body on springs where they
// are soft, a beam between pins where they are stiff, and the general search in between.
#include <gtest/gtest.h>

#include <cmath>

#include "analysis/undamped_critical_speeds.h"
#include "messages/input_error.h"

namespace whirl_twin {
namespace critical_speed_map_test {

constexpr double kPi = 3.14159265358979323846;
constexpr double kLength = 2.0;
constexpr double kDiameter = 0.05;
constexpr double kModulus = 2.0e11;
constexpr double kDensity = 7850.0;

/// Of Rayleigh's beam, in no bearings yet.
FlexibleShaft plainShaft() {
  FlexibleShaft shaft;
  shaft.material = {kModulus, 8.0e10, kDensity, false};
  shaft.elements.assign(16, {kLength / 16.0, kDiameter, 0.0});
  return shaft;
}
const double kArea = kPi * kDiameter * kDiameter / 4.0;
const double kSecondMoment = kPi * std::pow(kDiameter, 4) / 64.0;

// Up and down, 2k/m; tilting, k l^2/2 on the transverse inertia less the polar one.
TEST(CriticalSpeedMap, OnSoftBearingsIsThatOfARigidBody) {
  const CriticalSpeedMap map = criticalSpeedMap(plainShaft(), {0, 16}, 1.0, 10.0, 2, 3);
  const double mass = kDensity * kArea * kLength;
  const double polar = mass * kDiameter * kDiameter / 8.0;
  const double across = 0.5 * polar + mass * kLength * kLength / 12.0;
  for (std::size_t i = 0; i < 2; ++i) {
    const double k = map.stiffness[i];
    EXPECT_NEAR(map.speeds[0][i] / std::sqrt(2.0 * k / mass), 1.0, 1.0e-4);
    EXPECT_NEAR(map.speeds[1][i] / std::sqrt(0.5 * k * kLength * kLength / (across - polar)), 1.0,
                1.0e-4);
  }
}

// Between pins, forward as fast as it turns: w^2 = E I a^4 / (rho A - rho I a^2), a = n pi / l.
TEST(CriticalSpeedMap, OnStiffBearingsIsThatOfABeamBetweenPins) {
  const CriticalSpeedMap map = criticalSpeedMap(plainShaft(), {0, 16}, 1.0e6, 1.0e13, 8, 3);
  for (std::size_t n = 0; n < 3; ++n) {
    const double a = static_cast<double>(n + 1) * kPi / kLength;
    const double pinned = std::sqrt(kModulus * kSecondMoment * std::pow(a, 4) /
                                    (kDensity * (kArea - kSecondMoment * a * a)));
    // Cubic elements of length l_e are too stiff by (a l_e)^4 / 1440.
    EXPECT_NEAR(map.rigid[n] / pinned, 1.0, std::pow(a * kLength / 16.0, 4) / 1000.0);
    EXPECT_NEAR(map.speeds[n].back() / map.rigid[n], 1.0, 1.0e-5);
    for (std::size_t i = 0; i + 1 < map.stiffness.size(); ++i) {
      EXPECT_LT(map.speeds[n][i], map.speeds[n][i + 1]) << "stiffer is faster";
    }
  }
}

// A disc overhung, with a gyroscopic moment, hollow and tapering elements: the same as the search
// over all directions finds of the same rotor, of which the map has every second.
TEST(CriticalSpeedMap, HasTheForwardOnesOfAllUndampedCriticalSpeeds) {
  FlexibleShaft shaft = plainShaft();
  shaft.material.shear_deformation = true;
  shaft.elements[3].inner_diameter = 0.02;
  shaft.elements[5].outer_growth = 0.02;
  shaft.discs = {{16, 30.0, 0.6, 0.35}, {8, 20.0, 0.2, 0.12}};
  const double k = 3.0e6;
  const CriticalSpeedMap map = criticalSpeedMap(shaft, {2, 12}, k, 10.0 * k, 2, 4);
  BearingCoefficients b;
  b.kxx = b.kyy = k;
  b.cxx = b.cyy = 500.0;  // the map does not damp
  shaft.bearings = {{2, b}, {12, b}};
  const RotorAssembly assembly(shaft);
  std::vector<double> forward;
  for (const auto& one :
       undampedCriticalSpeeds(assembly.linearRotor(), assembly.stations(), 2.0e4)) {
    if (one.whirl == Whirl::kForward) {
      forward.push_back(one.speed);
    }
  }
  ASSERT_GE(forward.size(), 4u);
  for (std::size_t mode = 0; mode < 4; ++mode) {
    EXPECT_NEAR(map.speeds[mode][0] / forward[mode], 1.0, 1.0e-9);
  }
}

TEST(CriticalSpeedMap, OfOneBearingIsRefused) {
  EXPECT_THROW(criticalSpeedMap(plainShaft(), {3, 3}, 1.0, 10.0, 2, 3), InputError);
}

}  // namespace critical_speed_map_test
}  // namespace whirl_twin

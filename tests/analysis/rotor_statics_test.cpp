// Mass and static deflection of a shaft under its weight, against hand calculations by strength of
// materials.
#include "analysis/rotor_statics.h"

#include <gtest/gtest.h>

#include <cmath>

namespace whirl_twin {
namespace rotor_statics_test {

constexpr double kGravity = 9.80665;
constexpr double kPi = 3.14159265358979323846;

/// 2 m of 50 mm, 7850 kg/m^3, without shear deformation, in springs of 1e9 N/m at its ends.
FlexibleShaft plainShaft() {
  FlexibleShaft shaft;
  shaft.material = {2.0e11, 8.0e10, 7850.0, false};
  shaft.elements.assign(8, {0.25, 0.05, 0.0});
  BearingCoefficients b;
  b.kxx = b.kyy = 1.0e9;
  shaft.bearings = {{0, b}, {8, b}};
  return shaft;
}
const double kMass = 7850.0 * kPi * 0.05 * 0.05 / 4.0 * 2.0;
const double kBending = 2.0e11 * kPi * std::pow(0.05, 4) / 64.0;

TEST(RotorStatics, AUniformShaftCarriesItsWeightAsABeamDoes) {
  const RotorStatics statics = rotorStatics(plainShaft(), kGravity, 300.0).value();
  const double weight = kMass * kGravity;
  ASSERT_EQ(statics.bearings.size(), 2u);
  for (const BearingLoad& bearing : statics.bearings) {
    EXPECT_NEAR(bearing.force.y, 0.5 * weight, 1.0e-7 * weight);
    EXPECT_EQ(bearing.force.x, 0.0);
  }
  // 5 w l^4 / 384 EI below the springs, w l^2 / 8; the shear force falls evenly.
  const SagAtNode& middle = statics.nodes[4];
  EXPECT_NEAR(middle.deflection.y, -5.0 * weight * 8.0 / (384.0 * kBending) - 0.5e-9 * weight,
              1.0e-9);
  EXPECT_NEAR(middle.moment.y, weight * 2.0 / 8.0, 1.0e-6 * weight);
  EXPECT_NEAR(statics.nodes[2].shear_after.y, 0.25 * weight, 1.0e-6 * weight);
  EXPECT_NEAR(statics.nodes[2].moment.y, 3.0 / 32.0 * weight * 2.0, 1.0e-6 * weight);
  EXPECT_EQ(statics.nodes.front().shear_before.y, 0.0);
  EXPECT_NEAR(statics.nodes.back().shear_after.y, 0.0, 1.0e-6 * weight);
  EXPECT_NEAR(statics.nodes.back().moment.y, 0.0, 1.0e-6 * weight);
}

// 20 kg at a quarter of the span: P b / l and P a / l, P a b / l under it. And overhung: the lever.
TEST(RotorStatics, DiscsLoadTheBearingsByTheLever) {
  FlexibleShaft shaft = plainShaft();
  shaft.discs = {{2, 20.0, 0.1, 0.05}};
  const double weight = kMass * kGravity;
  const double load = 20.0 * kGravity;
  RotorStatics statics = rotorStatics(shaft, kGravity, 0.0).value();
  EXPECT_NEAR(statics.bearings[0].force.y, 0.5 * weight + 0.75 * load, 1.0e-7 * load);
  EXPECT_NEAR(statics.bearings[1].force.y, 0.5 * weight + 0.25 * load, 1.0e-7 * load);
  EXPECT_NEAR(statics.nodes[2].shear_before.y - statics.nodes[2].shear_after.y, load, 1.0e-9);
  EXPECT_NEAR(statics.nodes[2].moment.y, load * 0.5 * 1.5 / 2.0 + 3.0 / 32.0 * weight * 2.0,
              1.0e-6 * load);

  shaft.discs = {{8, 20.0, 0.1, 0.05}};
  shaft.bearings[1].node = 6;  // 1.5 m from the first, the disc 0.5 m beyond
  statics = rotorStatics(shaft, kGravity, 0.0).value();
  EXPECT_NEAR(statics.bearings[1].force.y, load * 2.0 / 1.5 + weight * 1.0 / 1.5, 1.0e-6 * load);
  EXPECT_NEAR(statics.bearings[0].force.y, -load * 0.5 / 1.5 + weight * 0.5 / 1.5, 1.0e-6 * load);
  EXPECT_NEAR(statics.nodes[6].moment.y, -load * 0.5 - 0.25 * weight * 0.25, 1.0e-6 * load);
}

// kxy and kyx push sideways what hangs in them: K x = -weight by hand, half on each.
TEST(RotorStatics, CrossCoupledBearingsLetItHangSideways) {
  FlexibleShaft shaft = plainShaft();
  for (RotorBearing& bearing : shaft.bearings) {
    bearing.coefficients.kxx = bearing.coefficients.kyy = 2.0e6;
    bearing.coefficients.kxy = 1.0e6;
    bearing.coefficients.kyx = -1.0e6;
  }
  const RotorStatics statics = rotorStatics(shaft, kGravity, 0.0).value();
  const double half = 0.5 * kMass * kGravity;
  EXPECT_NEAR(statics.nodes[0].deflection.x, half * 1.0e6 / 5.0e12, 1.0e-9 * half);
  EXPECT_NEAR(statics.nodes[0].deflection.y, -half * 2.0e6 / 5.0e12, 1.0e-9 * half);
  EXPECT_NEAR(statics.bearings[0].force.y, half, 1.0e-6 * half);
  EXPECT_NEAR(statics.bearings[0].force.x, 0.0, 1.0e-6 * half);
}

TEST(RotorStatics, OfARotorThatFloatsThereIsNone) {
  FlexibleShaft shaft = plainShaft();
  shaft.bearings.pop_back();
  EXPECT_FALSE(rotorStatics(shaft, kGravity, 0.0));
  shaft.bearings.clear();
  EXPECT_FALSE(rotorStatics(shaft, kGravity, 0.0));
}

// Statically a pedestal changes no load, and a sleeve that bends nothing is a weight.
TEST(RotorStatics, PedestalsCarryWhatTheirBearingsDo) {
  FlexibleShaft shaft = plainShaft();
  BearingCoefficients below;
  below.kxx = below.kyy = 1.0e7;
  shaft.pedestals = {{8, 50.0, 50.0, below}};
  shaft.sleeves = {{0, {shaft.material, {0.25, 0.1, 0.05}, 0.0}}};
  const RotorStatics statics = rotorStatics(shaft, kGravity, 0.0).value();
  const double weight = kMass * kGravity;
  const double sleeve = 3.0 * weight / 8.0;
  EXPECT_NEAR(statics.bearings[0].force.y, 0.5 * weight + sleeve * 1.875 / 2.0, 1.0e-6 * weight);
  EXPECT_NEAR(statics.bearings[1].force.y, 0.5 * weight + sleeve * 0.125 / 2.0, 1.0e-6 * weight);
  EXPECT_NEAR(statics.nodes[8].deflection.y, -statics.bearings[1].force.y * (1.0e-9 + 1.0e-7),
              1.0e-10);
  EXPECT_NEAR(statics.nodes.back().moment.y, 0.0, 1.0e-6 * weight);
  EXPECT_NEAR(rotorBody(shaft).mass, kMass * (1.0 + 3.0 / 8.0), 1.0e-9);
}

// A hollow shaft of 1 m and two discs: by hand.
TEST(RotorBody, HasTheMassAndInertiasOfItsParts) {
  FlexibleShaft shaft;
  shaft.material = {2.0e11, 8.0e10, 8000.0, true};
  shaft.elements = {{0.4, 0.1, 0.06}, {0.6, 0.1, 0.06}};
  shaft.discs = {{0, 10.0, 0.2, 0.1}, {1, 30.0, 0.6, 0.3}};
  const RotorBody body = rotorBody(shaft);
  const double tube = 8000.0 * kPi * (0.1 * 0.1 - 0.06 * 0.06) / 4.0;
  const double mass = tube + 40.0;
  const double centre = (tube * 0.5 + 30.0 * 0.4) / mass;
  const double squares = (0.1 * 0.1 + 0.06 * 0.06) / 16.0;  // of the radius of gyration
  EXPECT_NEAR(body.mass, mass, 1.0e-12 * mass);
  EXPECT_NEAR(body.centre, centre, 1.0e-12);
  EXPECT_NEAR(body.polar_inertia, 0.8 + tube * 2.0 * squares, 1.0e-12);
  EXPECT_NEAR(body.transverse_inertia,
              0.4 + tube * (1.0 / 12.0 + squares + std::pow(0.5 - centre, 2)) +
                  10.0 * centre * centre + 30.0 * std::pow(0.4 - centre, 2),
              1.0e-10);
}

}  // namespace rotor_statics_test
}  // namespace whirl_twin

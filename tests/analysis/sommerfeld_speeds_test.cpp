// Steady speeds on a weak motor: case G01, and the energy balance of rotors of many coordinates.
#include "analysis/sommerfeld_speeds.h"

#include <gtest/gtest.h>

#include <cmath>

#include "analysis/synchronous_response.h"
#include "models_under_test.h"
#include "rotors_under_test.h"

namespace whirl_twin {

namespace sommerfeld_speeds_test {

std::shared_ptr<const Dynamics> captured() {
  const auto reference = rotorCase("G01");
  const auto& p = reference["parameters"];
  return dynamicsOf(
      "jeffcott_rotor",
      {{"mass", p["m"]}, {"stiffness", p["k"]}, {"damping", p["c"]}, {"eccentricity", p["e"]}});
}

TEST(SommerfeldSpeeds, OfAWeakMotorAreThreeTheMiddleOneUnstable) {
  const auto dynamics = captured();
  const auto found = sommerfeldSpeeds(dynamics->linearRotor(), Motor::falling(0.3, 400.0), 400.0);
  const auto expected = expectedOf(rotorCase("G01"), "steady_roots_T=T_res");
  ASSERT_EQ(found.size(), expected.size());
  for (std::size_t i = 0; i < found.size(); ++i) {
    EXPECT_NEAR(found[i].speed, expected[i], 1.0e-8 * 400.0);
    EXPECT_EQ(found[i].stable, i != 1);
  }
}

// The quasi-static threshold of capture, G03's bound: below it three speeds, above it one.
TEST(SommerfeldSpeeds, OfAStrongMotorIsOne) {
  const auto dynamics = captured();
  EXPECT_EQ(sommerfeldSpeeds(dynamics->linearRotor(), Motor::falling(0.400, 400.0), 400.0).size(),
            3u);
  const auto found = sommerfeldSpeeds(dynamics->linearRotor(), Motor::falling(0.402, 400.0), 400.0);
  ASSERT_EQ(found.size(), 1u);
  EXPECT_TRUE(found[0].stable);
}

// The whirl torque as inferred from a probe: c w r^2 of each damper.
TEST(WhirlTorque, IsThePowerOfTheDampersOverTheSpeed) {
  RotorUnderTest r = chainRotor(4, 5.0e5, 1.4);
  addUnbalance(r, 1, {2.0e-5, 1.0e-5});
  for (const double speed : {100.0, 420.0, 700.0}) {
    const auto response = synchronousResponse(r.rotor, r.stations, speed);
    double expected = 0.0;
    for (const std::size_t end : {0u, 3u}) {
      expected += 0.5 * 60.0 * speed *
                  (std::norm(response.orbits[end].x) + std::norm(response.orbits[end].y));
    }
    EXPECT_NEAR(whirlTorque(r.rotor, speed) / expected, 1.0, 1.0e-9);
  }
}

// Internal damping does not act on a circular synchronous whirl: no torque.
TEST(WhirlTorque, OfInternalDampingAloneIsNone) {
  const auto dynamics = dynamicsOf(
      "jeffcott_rotor",
      {{"mass", 2.0}, {"stiffness", 7200.0}, {"internal_damping", 5.0}, {"eccentricity", 1e-4}});
  EXPECT_NEAR(whirlTorque(dynamics->linearRotor(), 50.0), 0.0, 1.0e-15);
}

}  // namespace sommerfeld_speeds_test

}  // namespace whirl_twin

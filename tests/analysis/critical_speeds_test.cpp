// Critical speeds and amplification factors against the Jeffcott rotor's closed forms and the
// reference case A05 (API 617/684).

#include "analysis/critical_speeds.h"

#include <gtest/gtest.h>

#include <cmath>
#include <fstream>
#include <nlohmann/json.hpp>

#include "analysis/synchronous_response.h"
#include "models_under_test.h"

namespace whirl_twin {

namespace critical_speeds_test {

std::shared_ptr<const Dynamics> rotor(double zeta, double stiffness_ratio = 1.0) {
  const double mass = 2.0;
  const double stiffness = 180000.0;  // p = 300 rad/s
  return dynamicsOf("jeffcott_rotor", {{"mass", mass},
                                       {"stiffness", stiffness},
                                       {"stiffness_y", stiffness * stiffness_ratio},
                                       {"damping", 2.0 * zeta * std::sqrt(mass * stiffness)}});
}

TEST(CriticalSpeeds, matchTheReferenceTable) {
  std::ifstream file(WHIRL_TWIN_REFERENCE "/rotor_cases.json");
  const auto cases = nlohmann::json::parse(file);
  int rows = 0;
  for (const auto& reference : cases) {
    if (reference["id"] != "A05_api_amplification_factor") {
      continue;
    }
    for (const auto& row : reference["expected"][0]["value"]) {
      const auto found = criticalSpeeds(*rotor(row["zeta"]));
      ASSERT_EQ(found.size(), 1u);
      EXPECT_NEAR(found[0].speed / 300.0, row["Nc_over_wn"], 1.0e-9);
      EXPECT_NEAR(found[0].lower / 300.0, row["N1"], 1.0e-9);
      EXPECT_NEAR(found[0].upper / 300.0, row["N2"], 1.0e-9);
      EXPECT_NEAR(found[0].amplification_factor, row["AF"], 1.0e-8);
      EXPECT_TRUE(found[0].forward);
      ++rows;
    }
  }
  EXPECT_EQ(rows, 4);
}

// Nc = p / sqrt(1 - 2 zeta^2), peak 1 / (2 zeta sqrt(1 - zeta^2)), over five decades of damping.
TEST(CriticalSpeeds, ofAJeffcottRotorForAnyDamping) {
  for (const double zeta : {1.0e-6, 1.0e-4, 1.0e-2, 0.05, 0.2, 0.4, 0.6}) {
    const auto found = criticalSpeeds(*rotor(zeta));
    ASSERT_EQ(found.size(), 1u) << zeta;
    const double expected = 300.0 / std::sqrt(1.0 - 2.0 * zeta * zeta);
    EXPECT_NEAR(found[0].speed, expected, 1.0e-11 * expected) << zeta;
    const double peak = 1.0 / (2.0 * zeta * std::sqrt(1.0 - zeta * zeta));
    EXPECT_NEAR(found[0].peak, peak, 1.0e-9 * peak) << zeta;
  }
}

// N2 does not exist for zeta > 0.38 (0.707 of the peak is below the response at infinity), and from
// 0.7072 on there is no peak at all.
TEST(CriticalSpeeds, fadeAwayWithDamping) {
  EXPECT_TRUE(std::isnan(criticalSpeeds(*rotor(0.4))[0].amplification_factor));
  EXPECT_FALSE(std::isnan(criticalSpeeds(*rotor(0.38))[0].amplification_factor));
  EXPECT_TRUE(criticalSpeeds(*rotor(0.75)).empty());
}

TEST(CriticalSpeeds, withoutDampingThePeakIsInfinite) {
  const auto found = criticalSpeeds(*rotor(0.0));
  ASSERT_EQ(found.size(), 1u);
  EXPECT_NEAR(found[0].speed, 300.0, 1.0e-9);
  EXPECT_TRUE(std::isinf(found[0].amplification_factor));
}

// Rotating damping does nothing in synchronous whirl: alone it leaves the peak infinite, though the
// modes at rest are damped.
TEST(CriticalSpeeds, rotatingDampingDoesNotTameThePeak) {
  const auto found = criticalSpeeds(*dynamicsOf(
      "jeffcott_rotor", {{"mass", 2.0}, {"stiffness", 7200.0}, {"internal_damping", 5.0}}));
  ASSERT_EQ(found.size(), 1u);
  EXPECT_NEAR(found[0].speed, 60.0, 1.0e-9);
  EXPECT_TRUE(std::isinf(found[0].amplification_factor));
}

// Two directions of different stiffness: two critical speeds, the response between them backward.
TEST(CriticalSpeeds, ofAnAnisotropicRotorComeInTwo) {
  const auto dynamics = rotor(0.005, 1.44);
  const auto found = criticalSpeeds(*dynamics);
  ASSERT_EQ(found.size(), 2u);
  EXPECT_NEAR(found[0].speed, 300.0, 0.1);
  EXPECT_NEAR(found[1].speed, 360.0, 0.1);
  const auto uneven = dynamicsOf("jeffcott_rotor", {{"mass", 2.0},
                                                    {"stiffness", 180000.0},
                                                    {"stiffness_y", 1.44 * 180000.0},
                                                    {"damping", 6.0},
                                                    {"eccentricity", 1.0e-4}});
  for (const double speed : {250.0, 330.0, 500.0}) {
    const auto response = synchronousResponse(uneven->linearRotor(), uneven->stations(), speed);
    EXPECT_EQ(response.orbits.front().direction(),
              speed == 330.0 ? Whirl::kBackward : Whirl::kForward);
  }
}

TEST(CriticalSpeeds, aPendulumHasNone) {
  EXPECT_TRUE(
      criticalSpeeds(*dynamicsOf("spinning_pendulum", {{"mass", 1.0}, {"length", 1.0}})).empty());
}

}  // namespace critical_speeds_test

}  // namespace whirl_twin

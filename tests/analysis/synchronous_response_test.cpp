// Unbalance response and its peaks: the Jeffcott tables A01 and A02, rotors of many coordinates.
#include "analysis/synchronous_response.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "analysis/critical_speeds.h"
#include "analysis/undamped_critical_speeds.h"
#include "models_under_test.h"
#include "rotors_under_test.h"

namespace whirl_twin {

namespace synchronous_response_test {

constexpr double kPi = 3.14159265358979323846;

TEST(SynchronousResponse, OfAJeffcottRotor) {
  for (const std::string id : {"A01", "A02"}) {
    const auto reference = rotorCase(id);
    const auto& p = reference["parameters"];
    const double eccentricity = p["e"];
    for (const double angle : {0.0, 1.1}) {
      const auto dynamics = dynamicsOf("jeffcott_rotor", {{"mass", p["m"]},
                                                          {"stiffness", p["k"]},
                                                          {"damping", p["c"]},
                                                          {"eccentricity", eccentricity},
                                                          {"eccentricity_angle", angle}});
      for (const auto& row : expectedOf(reference, "response_table")) {
        const auto response = synchronousResponse(dynamics->linearRotor(), dynamics->stations(),
                                                  row["r"].get<double>() * 300.0);
        const Orbit& orbit = response.orbits[0];
        EXPECT_NEAR(orbit.major() / eccentricity, row["amp_over_e"], 1.0e-9 * 25.0);
        EXPECT_NEAR(orbit.minor(), orbit.major(), 1.0e-9 * orbit.major());
        EXPECT_EQ(orbit.direction(), Whirl::kForward);
        EXPECT_NEAR(phaseLag(orbit, angle) * 180.0 / kPi, row["phase_lag_deg"], 1.0e-7);
      }
    }
  }
}

// x = a cos wt, y = b sin(wt): axes a, b; turned by an angle it keeps them.
TEST(Orbit, HasItsAxesInclinationAndDirection) {
  const std::complex<double> i(0.0, 1.0);
  for (const double turn : {0.0, 0.4, -1.2}) {
    for (const double b : {1.0, -1.0}) {
      const std::complex<double> x = 2.0, y = -i * b;
      const Orbit orbit(std::cos(turn) * x - std::sin(turn) * y,
                        std::sin(turn) * x + std::cos(turn) * y);
      EXPECT_NEAR(orbit.major(), 2.0, 1.0e-14);
      EXPECT_NEAR(orbit.minor(), 1.0, 1.0e-14);
      EXPECT_NEAR(orbit.inclination(), turn, 1.0e-14);
      EXPECT_EQ(orbit.direction(), b > 0.0 ? Whirl::kForward : Whirl::kBackward);
    }
  }
  EXPECT_EQ(Orbit(1.0, 0.5).direction(), Whirl::kStraight);
}

// A probe at a peak gives the sweep's value: every peak is resolved by the sweep.
TEST(SynchronousSweep, ResolvesEveryPeak) {
  RotorUnderTest r = chainRotor(3, 5.0e5, 1.3, 2.0);
  addUnbalance(r, 0, 1.0e-5);
  const auto criticals = criticalSpeeds(r.dynamics());
  ASSERT_EQ(criticals.size(), 6u);
  const auto sweep = synchronousSweep(r.rotor, r.stations, 0.0, 2.0e3, 20);
  EXPECT_EQ(sweep.front().speed, 0.0);
  EXPECT_EQ(sweep.back().speed, 2.0e3);
  for (const CriticalSpeed& critical : criticals) {
    double seen = 0.0;
    for (const SynchronousResponse& response : sweep) {
      if (std::fabs(response.speed - critical.speed) < 0.01 * critical.speed) {
        seen = std::max(seen, response.orbits[0].major());
      }
    }
    EXPECT_GT(seen, 0.998 * critical.peak) << critical.speed;  // another may be as near
    EXPECT_NEAR(critical.upper - critical.lower, critical.speed / critical.amplification_factor,
                1.0e-9 * critical.speed);
  }
}

// A rotor without unbalance responds as if its mass at the station had a unit eccentricity; with an
// unbalance the peaks are at the same speeds.
TEST(CriticalSpeeds, DoNotMoveWithTheSizeOfTheUnbalance) {
  RotorUnderTest unbalanced = chainRotor(2);
  addUnbalance(unbalanced, 0, {0.0, 2.0e-5});
  const auto with = criticalSpeeds(unbalanced.dynamics());
  const auto without = criticalSpeeds(chainRotor(2).dynamics());
  ASSERT_EQ(with.size(), without.size());
  for (std::size_t i = 0; i < with.size(); ++i) {
    EXPECT_NEAR(with[i].speed, without[i].speed, 1.0e-10 * with[i].speed);
    EXPECT_NEAR(with[i].amplification_factor, without[i].amplification_factor, 1.0e-8);
    EXPECT_NEAR(with[i].peak, 1.0e-5 * without[i].peak, 1.0e-14);  // 2e-5 kg m on 2 kg
  }
}

// Every peak of a rotor of many coordinates is at one of its forward undamped critical speeds,
// which the damping shifts by less than a percent; a mode with a node at the unbalance has none.
TEST(CriticalSpeeds, OfFortyCoordinates) {
  RotorUnderTest r = chainRotor(20, 5.0e5, 1.0, 20.0);
  addUnbalance(r, 3, 1.0e-5);
  const auto found = criticalSpeeds(r.dynamics());
  std::vector<double> forward;
  for (const auto& one : undampedCriticalSpeeds(r.rotor, r.stations, 1.0e4)) {
    if (one.whirl == Whirl::kForward) {
      forward.push_back(one.speed);
    }
  }
  ASSERT_EQ(forward.size(), 20u);
  ASSERT_GE(found.size(), 15u);
  for (const CriticalSpeed& one : found) {
    EXPECT_TRUE(one.forward);
    EXPECT_TRUE(std::any_of(forward.begin(), forward.end(), [&](double speed) {
      return std::fabs(one.speed / speed - 1.0) < 1.0e-2;
    })) << one.speed;
  }
}

// Gyroscopic moments: the peak of the lightly damped overhung disc is at its forward critical.
TEST(CriticalSpeeds, OfAnOverhungDiscIsItsForwardOne) {
  RotorUnderTest r = matrixRotor(rotorCase("C01"));
  addUnbalance(r, 0, 1.0e-4);
  const auto found = criticalSpeeds(r.dynamics());
  ASSERT_EQ(found.size(), 1u);
  for (const auto& one : undampedCriticalSpeeds(r.rotor, r.stations, 1.0e4)) {
    if (one.whirl == Whirl::kForward) {
      EXPECT_NEAR(found[0].speed, one.speed, 1.0e-6 * one.speed);
    }
  }
  EXPECT_TRUE(found[0].forward);
}

}  // namespace synchronous_response_test

}  // namespace whirl_twin

// The speeds at which a rotor loses its stability or finds it again: seen from below, from between
// and from above they are the same.
#include <gtest/gtest.h>

#include "monitoring/characteristic_speeds.h"
#include "watched_twin.h"

namespace whirl_twin {
namespace threshold_speeds_test {

TEST(ThresholdSpeeds, AreNeighboursOnBothSides) {
  const ThresholdSpeeds none;
  EXPECT_TRUE(std::isnan(none.lowest()));
  EXPECT_TRUE(std::isnan(none.below(5.0)));
  EXPECT_FALSE(none.unstableAt(5.0));
  const ThresholdSpeeds two({{100.0, true}, {120.0, false}});
  EXPECT_EQ(two.lowest(), 100.0);
  EXPECT_TRUE(std::isnan(two.below(-90.0)));
  EXPECT_EQ(two.above(-90.0), 100.0);
  EXPECT_EQ(two.below(110.0), 100.0);
  EXPECT_EQ(two.above(110.0), 120.0);
  EXPECT_EQ(two.below(130.0), 120.0);
  EXPECT_TRUE(std::isnan(two.above(130.0)));
  EXPECT_FALSE(two.unstableAt(90.0));
  EXPECT_TRUE(two.unstableAt(-110.0));
  EXPECT_FALSE(two.unstableAt(130.0));
  EXPECT_TRUE(two.between(130.0, 110.0));
  EXPECT_FALSE(two.between(105.0, -115.0));
  const ThresholdSpeeds always({{0.0, true}});
  EXPECT_EQ(always.lowest(), 0.0);
  EXPECT_TRUE(std::isnan(always.below(5.0)));
  EXPECT_TRUE(always.unstableAt(5.0));
}

// A shaft that is not round, k (1 +- mu), with external damping c: in the frame that turns with it
// the whirl diverges where (k (1 + mu) - m w^2)(k (1 - mu) - m w^2) + c^2 w^2 < 0, between two
// speeds, and is stable below and above.
TEST(ThresholdSpeeds, OfARotorThatIsStableAtBothEndsAreBothKnownEverywhere) {
  WatchedTwin watched(sceneOf(R"(
name: asymmetric
step: 0.001
drives:
  shaft:
    speed: 80.0
    profile: [{speed: 120.0, max_acceleration: 40.0, dwell: 1.0}]
systems:
  rotor:
    model: rigid_disc_rotor
    drive: shaft
    parameters: {mass: 1.0, polar_inertia: 0.02, transverse_inertia: 0.01, stiffness_displacement: 1.0e+4,
      stiffness_rotation: 500.0, stiffness_asymmetry: 0.2, damping_displacement: 2.0, damping_rotation: 0.1,
      frame: rotating}
    integrator: runge_kutta_4
    initial: {xi: 1.0e-9}
)"));
  watched.run(1.5);
  const double half = 0.5 * (2.0e4 - 4.0);
  const double root = std::sqrt(half * half - 1.0e8 * (1.0 - 0.04));
  const double low = std::sqrt(half - root);
  const double high = std::sqrt(half + root);
  ASSERT_GT(watched.margins.size(), 12u);
  for (const state::StabilityMargin& margin : watched.margins) {
    const double w = margin.speed;
    EXPECT_NEAR(margin.instability_speed, low, 1.0e-9 * low);
    EXPECT_EQ(margin.verdict_name == "unstable", w > low && w < high) << w;
    const double below = w > high ? high : w > low ? low : std::nan("");
    const double above = w < low ? low : w < high ? high : std::nan("");
    EXPECT_EQ(std::isnan(margin.threshold_below), std::isnan(below)) << w;
    EXPECT_EQ(std::isnan(margin.threshold_above), std::isnan(above)) << w;
    EXPECT_FALSE(std::fabs(margin.threshold_below - below) > 1.0e-9 * low) << w;
    EXPECT_FALSE(std::fabs(margin.threshold_above - above) > 1.0e-9 * low) << w;
  }
  EXPECT_EQ(watched.count("UNSTABLE", true), 1u);
}

// Its equilibrium moves with the speed, and the threshold is that of the whole branch: it stays
// where it is when it has been passed and the rotor whips.
TEST(ThresholdSpeeds, OfOilWhipStayWhereTheyAreInTheWhip) {
  WatchedTwin watched(sceneOf(R"(
name: oil_whip
step: 0.001
drives:
  shaft:
    speed: 150.0
    profile: [{speed: 350.0, max_acceleration: 100.0, dwell: 1.0}]
systems:
  rotor:
    model: jeffcott_rotor
    drive: shaft
    parameters: {mass: 2.0, stiffness: 20000.0, eccentricity: 5.0e-6, gravity_on_shaft: true, bearing_length: 0.01,
      bearing_diameter: 0.025, bearing_clearance: 1.0e-4, bearing_viscosity: 0.1, journal_mass: 0.2}
    initial: {y: -1.0e-3, journal_y: -2.0e-5}
)"));
  watched.run(3.0);
  ASSERT_GT(watched.margins.size(), 29u);
  const double threshold = watched.margins.front().instability_speed;
  EXPECT_NEAR(threshold, 186.1, 0.1);
  EXPECT_GT(watched.margins.back().speed, 340.0);
  for (const state::StabilityMargin& margin : watched.margins) {
    EXPECT_NEAR(margin.instability_speed, threshold, 1.0e-6) << margin.speed;
    const bool passed = margin.speed > threshold;
    EXPECT_NEAR(passed ? margin.threshold_below : margin.threshold_above, threshold, 1.0e-6);
    EXPECT_EQ(margin.verdict_name, passed ? "unstable" : "asymptotically_stable") << margin.speed;
  }
}

}  // namespace threshold_speeds_test
}  // namespace whirl_twin

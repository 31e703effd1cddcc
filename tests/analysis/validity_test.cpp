// The conditions for the validity of the equations, at the states where they are violated.
#include "analysis/validity.h"

#include <gtest/gtest.h>

#include <cmath>

#include "analysis/natural_modes.h"
#include "models_under_test.h"

namespace whirl_twin {
namespace validity_test {

Eigen::VectorXd vector(std::initializer_list<double> x) {
  return Eigen::Map<const Eigen::VectorXd>(x.begin(), static_cast<Eigen::Index>(x.size()));
}

/// Margin of a condition of the model at a state.
double margin(const Dynamics& dynamics, const std::string& name, const Eigen::VectorXd& q,
              const Eigen::VectorXd& v) {
  for (const Condition& c : validity(dynamics, q, v, {})) {
    if (c.name == name) {
      return c.margin;
    }
  }
  ADD_FAILURE() << dynamics.model() << " has no condition " << name;
  return std::nan("");
}

// The off-centre mass pulls the disc off its plane as it comes over the top at speed: at u = pi,
// u' = w the ground carries (M + m) g - m l w^2.
TEST(Validity, ADiscLiftsOffWhereItsMassPullsUpHarderThanItsWeight) {
  const double mass = 3.0, m = 1.0, r = 0.3, l = 0.2, g = 9.81;
  const auto disc = dynamicsOf("rolling_disc", {{"disc_mass", mass},
                                                {"disc_inertia", 0.135},
                                                {"radius", r},
                                                {"stiffness", 0.0},
                                                {"offset_mass", m},
                                                {"offset", l}});
  const double enough = std::sqrt((mass + m) * g / (m * l));
  for (const double share : {0.0, 0.9, 0.999, 1.001, 2.0}) {
    const double w = share * enough;
    EXPECT_NEAR(margin(*disc, "contact", vector({M_PI * r}), vector({w * r})),
                (mass + m) * g - m * l * w * w, 1e-10);
  }
}

// At rest away from the middle the plane holds the disc with F = J x'' / r^2 and x'' = -k x / m_e:
// it slips beyond |F| = mu m g.
TEST(Validity, ADiscSlipsWherePlaneAndSpringPullHarderThanFrictionHolds) {
  const double m = 2.0, inertia = 0.04, r = 0.2, k = 75.0, mu = 0.3, g = 9.81;
  const auto disc = dynamicsOf("rolling_disc", {{"disc_mass", m},
                                                {"disc_inertia", inertia},
                                                {"radius", r},
                                                {"stiffness", k},
                                                {"friction_coefficient", mu}});
  const double effective = m + inertia / (r * r);
  for (const double x : {0.05, 0.2, 0.25, 0.5}) {
    const double friction = inertia / (r * r) * k * x / effective;
    EXPECT_NEAR(margin(*disc, "no_slip", vector({x}), vector({0.0})), mu * m * g - friction, 1e-12);
  }
}

// Masses may differ by any ratio; a coordinate without inertia is singular.
TEST(Validity, AMassMatrixIsSingularOnlyWhereSomethingHasNoInertia) {
  const Eigen::VectorXd rest = vector({0.3, 0.2});
  const Eigen::VectorXd in_line = vector({0.3, 0.3});
  for (const double ratio : {1e-16, 1e-8, 1.0, 1e8, 1e17}) {
    const auto pendulum = dynamicsOf(
        "double_pendulum", {{"mass1", 1.0}, {"mass2", ratio}, {"length1", 1.0}, {"length2", 1e-6}});
    EXPECT_FALSE(massIsSingular(*pendulum, rest, rest, {})) << ratio;
    EXPECT_EQ(massIsSingular(*pendulum, in_line, rest, {}), ratio > 1e10)
        << "what can turn without the heavy mass is lost in its rounding: " << ratio;
  }
  const auto free =
      dynamicsOf("rotating_pendulum", {{"mass", 1.0}, {"length", 0.5}, {"hub_inertia", 0.0}});
  EXPECT_TRUE(massIsSingular(*free, vector({0.0, 0.0}), rest, {}));
  EXPECT_FALSE(massIsSingular(*free, vector({1e-6, 0.0}), rest, {}));
}

TEST(Validity, ASliderLeavesItsRodAtEitherEnd) {
  const auto rod = dynamicsOf("rod_slider", {{"slider_mass", 1.0},
                                             {"rod_mass", 0.5},
                                             {"rod_length", 1.2},
                                             {"stiffness", 60.0},
                                             {"free_length", 0.5}});
  EXPECT_NEAR(margin(*rod, "rod_end", vector({0.7, 0.3}), vector({0.0, 0.0})), 0.5, 1e-15);
  EXPECT_LT(margin(*rod, "rod_end", vector({1.21, 0.3}), vector({0.0, 0.0})), 0.0);
  EXPECT_LT(margin(*rod, "rod_end", vector({-0.01, 0.3}), vector({0.0, 0.0})), 0.0);
}

// Both rollers carry the plank while |x| < a - mu h, and both slide while |x'| < v_s.
TEST(Validity, APlankSlidesOnBothRollersWithinLimits) {
  const double a = 0.0762, h = 0.0127, mu = 0.3;
  Settings sliding;
  sliding.choices["friction"] = "sliding";
  const auto plank = dynamicsOf("friction_oscillator",
                                {{"mass", 1.0},
                                 {"friction_coefficient", mu},
                                 {"half_spacing", a},
                                 {"height", h},
                                 {"roller_speed", 0.5}},
                                9.81, sliding);
  const double reach = a - mu * h;
  for (const double side : {1.0, -1.0}) {
    EXPECT_GT(margin(*plank, "contact", vector({side * 0.999 * reach}), vector({0.0})), 0.0);
    EXPECT_LT(margin(*plank, "contact", vector({side * 1.001 * reach}), vector({0.0})), 0.0);
    EXPECT_NEAR(margin(*plank, "sliding", vector({0.0}), vector({side * 0.4})), 0.1, 1e-15);
    EXPECT_LT(margin(*plank, "sliding", vector({0.0}), vector({side * 0.6})), 0.0);
  }
}

TEST(Validity, AFlywheelsMassesStayOnTheirSides) {
  const auto wheel = dynamicsOf(
      "sliding_mass_flywheel",
      {{"inertia", 0.05}, {"slider_mass", 0.3}, {"stiffness", 200.0}, {"free_length", 0.2}});
  const Eigen::VectorXd rest = vector({0.0, 0.0, 0.0});
  EXPECT_GT(margin(*wheel, "slider_past_centre", vector({0.1, 0.2, 0.0}), rest), 0.0);
  EXPECT_LT(margin(*wheel, "slider_past_centre", vector({0.1, -0.01, 0.0}), rest), 0.0);
}

// Without a hub the pendulum has m l^2 sin^2(theta) about the vertical, and hanging nothing.
TEST(Validity, APendulumWithoutAHubLosesItsInertiaAsItHangs) {
  const auto pendulum =
      dynamicsOf("rotating_pendulum", {{"mass", 1.0}, {"length", 0.5}, {"hub_inertia", 0.0}});
  const Eigen::VectorXd turning = vector({0.0, 1.0});
  EXPECT_FALSE(pendulum->singularMass().empty());
  EXPECT_GT(margin(*pendulum, "regular_mass", vector({0.1, 0.0}), turning), 0.0);
  EXPECT_LT(margin(*pendulum, "regular_mass", vector({1e-6, 0.0}), turning), 0.0);
  EXPECT_NEAR(massRegularity(*pendulum, vector({0.01, 0.0}), turning, {}),
              std::pow(std::sin(0.01), 2), 1e-12);
  const auto with_hub =
      dynamicsOf("rotating_pendulum", {{"mass", 1.0}, {"length", 0.5}, {"hub_inertia", 0.01}});
  EXPECT_TRUE(with_hub->singularMass().empty());
  EXPECT_FALSE(hasConditions(*with_hub));
}

TEST(Validity, WhatIsBrokenIsSaidInWords) {
  EXPECT_EQ(brokenText({{"contact", "N", 1.0, "it lifts off"}}, Margins::kShown), "");
  EXPECT_EQ(brokenText({{"contact", "N", -0.25, "it lifts off"},
                        {"sliding", "m/s", 0.1, "it sticks"},
                        {"regular_mass", "-", 0.0, "no inertia"}},
                       Margins::kShown),
            "it lifts off (contact -0.25 N); no inertia (regular_mass 0)");
  EXPECT_EQ(brokenText({{"contact", "N", -0.25, "it lifts off"}}, Margins::kLeftOut),
            "it lifts off (contact)");
  EXPECT_NE(brokenText({{"contact", "N", std::nan(""), "it lifts off"}}, Margins::kShown), "")
      << "what cannot be told does not hold";
}

}  // namespace validity_test
}  // namespace whirl_twin

// Equilibria of systems that slide, roll or turn freely, against the notes' closed forms.

#include <gtest/gtest.h>

#include <cmath>

#include "analysis/equilibria.h"
#include "models_under_test.h"

namespace whirl_twin {

namespace slide_equilibria_test {

constexpr double kPi = 3.14159265358979323846;
constexpr double kGravity = 9.81;

Verdict verdict(const Equilibrium& e) {
  return e.stability.routh.verdict;
}

/// A disc whose restoring stiffness by weight is kappa = k r^2 / (m g l) times less than that of
/// its spring.
std::vector<Equilibrium> ofDisc(double radius, double kappa) {
  const double offset = 2.0 / 3.0 * radius;
  return equilibria(
      *dynamicsOf("rolling_disc", {{"disc_mass", 3.0},
                                   {"disc_inertia", 1.5 * radius * radius},
                                   {"radius", radius},
                                   {"stiffness", kappa * kGravity * offset / (radius * radius)},
                                   {"offset_mass", 1.0},
                                   {"offset", offset}}),
      0.0);
}

ParameterValues cart(double stiffness) {
  return {{"cart_mass", 2.0}, {"rod_mass", 1.0}, {"rod_length", 1.0}, {"stiffness", stiffness}};
}

// tan(theta) = 2 P / (m g), and the same half a turn on, over the pins.
TEST(Equilibria, aTwoBarLinkageRestsBelowAndBalancesAbove) {
  const auto all = equilibria(
      *dynamicsOf("two_bar_linkage", {{"bar_mass", 2.0}, {"bar_length", 1.0}, {"force", 10.0}}),
      0.0);
  const double rest = std::atan(2.0 * 10.0 / (2.0 * kGravity));
  ASSERT_EQ(all.size(), 2u);
  EXPECT_NEAR(all[0].q[0], rest - kPi, 1.0e-14);
  EXPECT_EQ(verdict(all[0]), Verdict::kUnstable);
  EXPECT_NEAR(all[1].q[0], rest, 1.0e-14);
  EXPECT_EQ(verdict(all[1]), Verdict::kMarginal);
}

TEST(Equilibria, aDiscWithAStiffSpringHasOne) {
  for (const double kappa : {0.2173, 0.917, 100.0}) {
    const auto all = ofDisc(0.3, kappa);
    ASSERT_EQ(all.size(), 1u) << kappa;
    EXPECT_EQ(all[0].q[0], 0.0);
    EXPECT_EQ(verdict(all[0]), Verdict::kMarginal);
  }
}

// sin u = -kappa u, u = x / r, has another pair on each side below kappa = 0.21723, 0.09133,
// 0.05797 (where tan u = u). Whether the disc is of 3 mm or of 30 m must not matter.
TEST(Equilibria, aDiscWithASoftSpringHasPairsToBothSides) {
  for (const double radius : {0.003, 0.3, 30.0}) {
    for (const auto& [kappa, pairs] :
         {std::pair{0.2172, 1}, std::pair{0.092, 1}, std::pair{0.091, 2}, std::pair{0.0459, 3}}) {
      const auto all = ofDisc(radius, kappa);
      ASSERT_EQ(all.size(), 1u + 4u * static_cast<unsigned>(pairs)) << radius << ", " << kappa;
      for (std::size_t i = 0; i < all.size(); ++i) {
        const double u = all[i].q[0] / radius;
        EXPECT_NEAR(std::sin(u), -kappa * u, 1.0e-12);
        EXPECT_EQ(verdict(all[i]), i % 2 == 0 ? Verdict::kMarginal : Verdict::kUnstable);
      }
    }
  }
}

// Without a spring it is in equilibrium with its weight below (stable) and above (unstable), in
// every turn.
TEST(Equilibria, aDiscWithoutASpringHasOneEveryHalfTurn) {
  const auto all = ofDisc(0.3, 0.0);
  ASSERT_GE(all.size(), 2u * 8u);
  for (const Equilibrium& e : all) {
    const double half_turns = e.q[0] / (0.3 * kPi);
    EXPECT_NEAR(half_turns, std::round(half_turns), 1.0e-12);
    EXPECT_EQ(verdict(e),
              std::lround(half_turns) % 2 == 0 ? Verdict::kMarginal : Verdict::kUnstable);
  }
}

// r = r0 +- m0 g / k: hanging and inverted. On a spring as soft as the first the slider can get so
// far behind the pivot that it hangs there, and balances the rod at r = -m l / (2 m0) to both
// sides.
TEST(Equilibria, aSliderRestsBelowAndBalancesAboveItsPivot) {
  for (const double stiffness : {5.0, 60.0, 1.0e6}) {
    const auto all = equilibria(*dynamicsOf("rod_slider", {{"slider_mass", 1.0},
                                                           {"rod_mass", 0.5},
                                                           {"rod_length", 1.2},
                                                           {"stiffness", stiffness},
                                                           {"free_length", 0.5}}),
                                0.0);
    const double sag = kGravity / stiffness;
    const auto at = [&](double r, double theta) {
      for (const Equilibrium& e : all) {
        if (std::fabs(e.q[0] - r) < 1.0e-13 * (1.0 + sag) && std::fabs(e.q[1] - theta) < 1.0e-13) {
          return e.stability.routh.verdict;
        }
      }
      ADD_FAILURE() << "none at r = " << r << ", theta = " << theta;
      return Verdict::kUncertain;
    };
    EXPECT_EQ(at(0.5 + sag, 0.0), Verdict::kMarginal);
    EXPECT_EQ(at(0.5 - sag, kPi), 0.5 - sag > -0.3 ? Verdict::kUnstable : Verdict::kMarginal);
    EXPECT_EQ(all.size(), stiffness == 5.0 ? 4u : 2u);
    if (stiffness == 5.0) {
      const double lean = std::acos(-0.8 / sag);
      EXPECT_EQ(at(-0.3, lean), Verdict::kUnstable);
      EXPECT_EQ(at(-0.3, -lean), Verdict::kUnstable);
    }
  }
}

// Weightless, on a spring of no length: the slider at the pivot, the rod at any angle.
TEST(Equilibria, aWeightlessSliderRestsAtItsSpringsEnd) {
  for (const double free_length : {0.0, 0.5}) {
    const auto all = equilibria(*dynamicsOf("rod_slider",
                                            {{"slider_mass", 1.0},
                                             {"rod_mass", 0.5},
                                             {"rod_length", 1.2},
                                             {"stiffness", 60.0},
                                             {"free_length", free_length}},
                                            0.0),
                                0.0);
    ASSERT_EQ(all.size(), 1u);
    EXPECT_NEAR(all[0].q[0], free_length, 1.0e-15);
    EXPECT_EQ(all[0].q[1], 0.0);
  }
}

TEST(Equilibria, aCartsRodHangsOrStands) {
  ParameterValues loaded = cart(30.0);
  loaded.insert({{"force_amplitude", 0.04},
                 {"force_frequency", 3.0},
                 {"support_amplitude", 0.002},
                 {"support_frequency", 3.0}});
  // Alternating loads do not displace it; a cart without a spring is in equilibrium anywhere: at 0
  // by convention.
  for (const ParameterValues& parameters : {cart(30.0), loaded, cart(0.0)}) {
    const auto all = equilibria(*dynamicsOf("cart_pendulum", parameters), 0.0);
    ASSERT_EQ(all.size(), 2u);
    EXPECT_EQ(all[0].q[0], 0.0);
    EXPECT_EQ(all[0].q[1], 0.0);
    EXPECT_EQ(all[1].q[0], 0.0);
    EXPECT_NEAR(all[1].q[1], kPi, 1.0e-14);
    // About standing no periodic motion need be found: then nothing is known, and never "stable".
    const bool driven = parameters.count("force_amplitude") != 0;
    EXPECT_TRUE(verdict(all[1]) == Verdict::kUnstable ||
                (driven && verdict(all[1]) == Verdict::kUncertain));
    if (parameters.at("stiffness") > 0.0) {
      EXPECT_EQ(verdict(all[0]), Verdict::kMarginal);
    }
  }
}

// A constant force at the tip: k x = F and tan(theta) = 2 F / (m2 g); without a spring, off it
// goes.
TEST(Equilibria, aConstantForceDisplacesACart) {
  ParameterValues pushed = cart(30.0);
  pushed["force_amplitude"] = 4.0;
  const auto all = equilibria(*dynamicsOf("cart_pendulum", pushed), 0.0);
  ASSERT_EQ(all.size(), 2u);
  const double lean = std::atan(2.0 * 4.0 / kGravity);
  EXPECT_NEAR(all[0].q[0], 4.0 / 30.0, 1.0e-14);
  EXPECT_NEAR(all[1].q[0], 4.0 / 30.0, 1.0e-14);
  EXPECT_NEAR(std::min(std::fabs(all[0].q[1] - lean), std::fabs(all[1].q[1] - lean)), 0.0, 1e-14);
  EXPECT_NEAR(std::fabs(all[0].q[1] - all[1].q[1]), kPi, 1.0e-14);
  pushed["stiffness"] = 0.0;
  EXPECT_TRUE(equilibria(*dynamicsOf("cart_pendulum", pushed), 0.0).empty());
}

// beta = m g / (k L): upright is stable below 1, with unstable ones at +-acos(beta).
TEST(Equilibria, aSprungInvertedPendulumIsHeldIfItsSpringIsStiff) {
  const auto of = [](double stiffness) {
    return equilibria(*dynamicsOf("sprung_inverted_pendulum",
                                  {{"mass", 1.0}, {"length", 1.0}, {"stiffness", stiffness}}),
                      0.0);
  };
  const auto stiff = of(30.0);
  const double lean = std::acos(kGravity / 30.0);
  ASSERT_EQ(stiff.size(), 4u);
  EXPECT_NEAR(stiff[0].q[0], -lean, 1.0e-14);
  EXPECT_EQ(stiff[1].q[0], 0.0);
  EXPECT_NEAR(stiff[2].q[0], lean, 1.0e-14);
  EXPECT_NEAR(stiff[3].q[0], kPi, 1.0e-14);
  for (std::size_t i = 0; i < 4; ++i) {
    EXPECT_EQ(verdict(stiff[i]), i % 2 == 0 ? Verdict::kUnstable : Verdict::kMarginal);
  }
  const auto soft = of(5.0);
  ASSERT_EQ(soft.size(), 2u);
  EXPECT_EQ(soft[0].q[0], 0.0);
  EXPECT_EQ(verdict(soft[0]), Verdict::kUnstable);
  EXPECT_NEAR(soft[1].q[0], kPi, 1.0e-14);
  EXPECT_EQ(verdict(soft[1]), Verdict::kMarginal);
}

// Nothing pulls along phi: hanging and standing are the same at every phi, and named at 0.
TEST(Equilibria, aRotatingPendulumHangsOrStandsAtAnyTurn) {
  const auto of = [](double hub) {
    return equilibria(
        *dynamicsOf("rotating_pendulum", {{"mass", 1.0}, {"length", 0.5}, {"hub_inertia", hub}}),
        0.0);
  };
  const auto all = of(0.05);
  ASSERT_EQ(all.size(), 2u);
  EXPECT_EQ(all[0].q, Eigen::Vector2d(0.0, 0.0));
  EXPECT_NEAR(all[1].q[0], kPi, 1.0e-14);
  EXPECT_EQ(all[1].q[1], 0.0);
  EXPECT_EQ(verdict(all[1]), Verdict::kUnstable);
  // Without a hub phi means nothing where it hangs.
  ASSERT_EQ(of(0.0).size(), 1u);
  EXPECT_NEAR(of(0.0)[0].q[0], kPi, 1.0e-14);
}

}  // namespace slide_equilibria_test

}  // namespace whirl_twin

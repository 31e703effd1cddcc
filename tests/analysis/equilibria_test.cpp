// Equilibria and thresholds of the pendulums against their closed forms.

#include "analysis/equilibria.h"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "analysis/instability_speed.h"
#include "models_under_test.h"

namespace whirl_twin {

namespace equilibria_test {

constexpr double kPi = 3.14159265358979323846;
constexpr double kGravity = 9.8044;
constexpr double kLength = 0.2032;

std::shared_ptr<const Dynamics> spinning(double damping = 0.0) {
  return dynamicsOf("spinning_pendulum", {{"mass", 0.5}, {"length", kLength}, {"damping", damping}},
                    kGravity);
}

Eigen::VectorXd angle(double theta) {
  return Eigen::VectorXd::Constant(1, theta);
}

TEST(Equilibria, aSpinningPendulumBelowTheBifurcationHangs) {
  const auto all = equilibria(*spinning(), 5.0);
  ASSERT_EQ(all.size(), 2u);
  EXPECT_EQ(all[0].q[0], 0.0);
  EXPECT_EQ(all[0].stability.routh.verdict, Verdict::kMarginal);
  EXPECT_NEAR(all[1].q[0], kPi, 1.0e-14);
  EXPECT_EQ(all[1].stability.routh.verdict, Verdict::kUnstable);
}

// cos theta = g / (l w^2), with frequency w sin theta about it.
TEST(Equilibria, beyondItLeavesTheVerticalToBothSides) {
  const double speed = 9.0;
  const double cone = std::acos(kGravity / (kLength * speed * speed));
  const auto all = equilibria(*spinning(), speed);
  ASSERT_EQ(all.size(), 4u);
  EXPECT_NEAR(all[0].q[0], -cone, 1.0e-13);
  EXPECT_EQ(all[1].q[0], 0.0);
  EXPECT_NEAR(all[2].q[0], cone, 1.0e-13);
  EXPECT_EQ(all[1].stability.routh.verdict, Verdict::kUnstable);
  EXPECT_EQ(all[2].stability.routh.verdict, Verdict::kMarginal);
  ASSERT_EQ(all[2].stability.natural_frequencies.size(), 1u);
  EXPECT_NEAR(all[2].stability.natural_frequencies[0], speed * std::sin(cone), 1.0e-12);
}

TEST(Equilibria, aDoublePendulumHasFourAndOneIsStable) {
  const auto pendulum = dynamicsOf(
      "double_pendulum", {{"mass1", 1.0}, {"mass2", 1.0}, {"length1", 1.0}, {"length2", 1.0}});
  const auto all = equilibria(*pendulum, 0.0);
  ASSERT_EQ(all.size(), 4u);
  int stable = 0;
  for (const Equilibrium& e : all) {
    stable += e.stability.bounded() ? 1 : 0;
    EXPECT_EQ(e.stability.bounded(), e.q.norm() == 0.0);
  }
  EXPECT_EQ(stable, 1);
  // p^2 = (2 -+ sqrt 2) g / l
  const auto& frequencies = all[0].stability.natural_frequencies;
  ASSERT_EQ(frequencies.size(), 2u);
  EXPECT_NEAR(frequencies[0], std::sqrt((2.0 - std::sqrt(2.0)) * 9.81), 1.0e-12);
  EXPECT_NEAR(frequencies[1], std::sqrt((2.0 + std::sqrt(2.0)) * 9.81), 1.0e-12);
}

TEST(OperatingPoint, isTheNearestStableOneByTheShorterWayRound) {
  const double speed = 9.0;
  const double cone = std::acos(kGravity / (kLength * speed * speed));
  EXPECT_NEAR(operatingPoint(*spinning(), angle(0.2), angle(0.0), speed)->q[0], cone, 1.0e-12);
  EXPECT_NEAR(operatingPoint(*spinning(), angle(-0.2), angle(0.0), speed)->q[0], -cone, 1.0e-12);
  EXPECT_NEAR(operatingPoint(*spinning(), angle(2.0 * kPi - 0.2), angle(0.0), speed)->q[0], -cone,
              1.0e-12);
  EXPECT_EQ(operatingPoint(*spinning(), angle(1.0), angle(0.0), 5.0)->q[0], 0.0);
}

TEST(InstabilitySpeed, ofAHangingPendulumIsTheBifurcation) {
  const auto found = instabilitySpeed(*spinning(0.01), angle(0.0), 2.0);
  ASSERT_TRUE(found.has_value());
  EXPECT_NEAR(*found, std::sqrt(kGravity / kLength), 1.0e-9);
}

TEST(InstabilitySpeed, onTheConeThereIsNone) {
  const double speed = 9.0;
  const double cone = std::acos(kGravity / (kLength * speed * speed));
  EXPECT_FALSE(instabilitySpeed(*spinning(0.01), angle(cone), speed).has_value());
}

// W = p (1 + c_e / c_i), over random rotors.
TEST(InstabilitySpeed, ofARotorWithInternalDampingIsKimballs) {
  std::mt19937 random(3);
  std::uniform_real_distribution<double> decade(-1.0, 1.0);
  for (int trial = 0; trial < 40; ++trial) {
    const double mass = std::pow(10.0, decade(random));
    const double stiffness = 1.0e5 * std::pow(10.0, decade(random));
    const double external = 20.0 * std::pow(10.0, decade(random));
    const double internal = 10.0 * std::pow(10.0, decade(random));
    const auto rotor = dynamicsOf("jeffcott_rotor", {{"mass", mass},
                                                     {"stiffness", stiffness},
                                                     {"damping", external},
                                                     {"internal_damping", internal}});
    const double p = std::sqrt(stiffness / mass);
    const double threshold = p * (1.0 + external / internal);
    const auto found = instabilitySpeed(*rotor, Eigen::VectorXd::Zero(2), 0.0);
    ASSERT_TRUE(found.has_value());
    EXPECT_NEAR(*found, threshold, 1.0e-9 * threshold);
  }
}

// However slowly it grows beyond: W = 2 p, with a growth rate of some 1e-8 1/s there.
TEST(InstabilitySpeed, isExactWhereGrowthIsSlow) {
  const auto rotor = dynamicsOf(
      "jeffcott_rotor",
      {{"mass", 2.0}, {"stiffness", 7200.0}, {"damping", 1.0e-6}, {"internal_damping", 1.0e-6}});
  const auto found = instabilitySpeed(*rotor, Eigen::VectorXd::Zero(2), 0.0);
  ASSERT_TRUE(found.has_value());
  EXPECT_NEAR(*found, 120.0, 1.0e-9);
}

TEST(InstabilitySpeed, withoutInternalDampingARotorHasNone) {
  const auto rotor =
      dynamicsOf("jeffcott_rotor", {{"mass", 2.0}, {"stiffness", 7200.0}, {"damping", 12.0}});
  EXPECT_FALSE(instabilitySpeed(*rotor, Eigen::VectorXd::Zero(2), 0.0).has_value());
}

}  // namespace equilibria_test

}  // namespace whirl_twin

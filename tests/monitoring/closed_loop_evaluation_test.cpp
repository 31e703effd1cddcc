// A system with controllers is judged as they sample it.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <memory>

#include "monitoring/stability_evaluator.h"
#include "scene/built_scene.h"
#include "scene/changed_controller.h"
#include "watched_twin.h"

namespace whirl_twin {
namespace closed_loop_evaluation_test {

/// x'' = x + u, sampled ten times a second, so late.
BuiltScene levitated(double delay) {
  return build(sceneOf(fmt::format(
      "{{step: 0.001, systems: {{s: {{model: linear_system, parameters: {{names: [x], mass: "
      "[[1.0]], stiffness: [[-1.0]]}}}}}}, controllers: {{pd: {{type: pid, rate: 10.0, measures: "
      "[s.x], acts_on: [s.force_x], delay: {}, parameters: {{kp: 2.0, ki: 0.0, kd: "
      "1.4142135623730951}}}}}}}}",
      delay)));
}

state::StabilityMargin judged(const BuiltScene& scene) {
  StabilityEvaluator evaluator(scene.systems[0],
                               std::make_shared<const ClosedLoop>(closedLoops(scene.scene)[0]));
  return evaluator.evaluate({5, 0.005, 0}, {1.0e-3}, {0.0}, 0.0);
}

TEST(ClosedLoopEvaluation, WhatIsUnstableByItselfIsStableWithItsController) {
  const BuiltScene scene = levitated(0.1);
  EXPECT_EQ(StabilityEvaluator(scene.systems[0])
                .evaluate({5, 0.005, 0}, {1.0e-3}, {0.0}, 0.0)
                .verdict_name,
            "unstable");
  const state::StabilityMargin margin = judged(scene);
  EXPECT_EQ(margin.verdict_name, "asymptotically_stable");
  EXPECT_EQ(margin.right, 0u);
  EXPECT_EQ(margin.polynomial.size(), margin.left + 1u);
  // Spectral radius 0.926013966 a sample of 0.1 s.
  EXPECT_NEAR(margin.decay_rate, -std::log(0.926013966) / 0.1, 1e-7);
  EXPECT_FALSE(margin.routh_disagrees);
}

TEST(ClosedLoopEvaluation, TooLateItIsUnstable) {
  const state::StabilityMargin margin = judged(levitated(0.7));
  EXPECT_EQ(margin.verdict_name, "unstable");
  EXPECT_GT(margin.right, 0u);
  EXPECT_LT(margin.decay_rate, 0.0);
}

// kp = 0.9 is less than the magnet's negative stiffness.
TEST(ClosedLoopEvaluation, VerdictAndMarginsFollowTheParametersOfAController) {
  const BuiltScene scene = levitated(0.1);
  WatchedTwin watched(scene.scene);
  watched.run(0.2);
  ASSERT_FALSE(watched.margins.empty());
  EXPECT_EQ(watched.margins.back().verdict_name, "asymptotically_stable");
  state::ParameterChange change = parametersOf(scene.scene.controllers[0]);
  EXPECT_TRUE(watched.monitor.take(change)) << "as they are";
  EXPECT_TRUE(watched.monitor.takeMargins().empty()) << "it is judged already";
  const auto kp = std::find(change.values.begin(), change.values.end(), 2.0);
  ASSERT_FALSE(watched.loop_margins.empty());
  EXPECT_NEAR(watched.loop_margins.back().gain_reduction, 0.5, 1e-9) << "of 1 in 2 N/m";
  *kp = 1.6;
  ASSERT_TRUE(watched.monitor.take(change));
  const auto of_loop = watched.monitor.takeLoopMargins();
  ASSERT_FALSE(of_loop.empty());
  EXPECT_NEAR(of_loop.back().gain_reduction, 1.0 / 1.6, 1e-9) << "of 1 in 1.6";
  EXPECT_EQ(watched.monitor.takeMargins().size(), 1u);
  *kp = 0.9;
  ASSERT_TRUE(watched.monitor.take(change));
  const auto margins = watched.monitor.takeMargins();
  ASSERT_EQ(margins.size(), 1u) << "at once";
  EXPECT_EQ(margins[0].verdict_name, "unstable");
  EXPECT_EQ(margins[0].right, 1u);
  change.names.pop_back();
  change.values.pop_back();
  EXPECT_FALSE(watched.monitor.take(change)) << "not a set of this controller";
  change.system = "pp";
  EXPECT_FALSE(watched.monitor.take(change));
}

constexpr const char* kTied =
    "controllers: {{there: {{type: pid, rate: 10.0, measures: [{0}], acts_on: [{3}], delay: 0.05, "
    "parameters: {{kp: {4}, ki: 0.0, kd: 0.3}}}}, back: {{type: pid, rate: 20.0, measures: [{1}], "
    "acts_on: [{2}], delay: 0.02, parameters: {{kp: {4}, ki: 0.0, kd: 0.1}}}}}}";

/// A mass at x and one at y that two controllers tie to each other, in two systems.
Scene tiedSystems(double gain) {
  return sceneOf(
      "{step: 0.001, systems: {a: {model: linear_system, parameters: {names: [x], mass: [[1.0]], "
      "damping: [[0.2]], stiffness: [[4.0]]}}, b: {model: linear_system, parameters: {names: [y], "
      "mass: [[2.0]], damping: [[0.1]], stiffness: [[3.0]]}}}, " +
      fmt::format(kTied, "a.x", "b.y", "a.force_x", "b.force_y", gain) + "}");
}

/// The same in one.
Scene tiedCoordinates(double gain) {
  return sceneOf(
      "{step: 0.001, systems: {s: {model: linear_system, parameters: {names: [x, y], mass: [[1.0, "
      "0.0], [0.0, 2.0]], damping: [[0.2, 0.0], [0.0, 0.1]], stiffness: [[4.0, 0.0], [0.0, "
      "3.0]]}}}, " +
      fmt::format(kTied, "s.x", "s.y", "s.force_x", "s.force_y", gain) + "}");
}

TEST(ClosedLoopEvaluation, ALoopThroughSeveralSystemsIsJudgedAsIfTheyWereOne) {
  for (const double gain : {0.5, 8.0}) {
    WatchedTwin several(tiedSystems(gain)), one(tiedCoordinates(gain));
    several.run(0.5);
    one.run(0.5);
    ASSERT_FALSE(one.margins.empty());
    const state::StabilityMargin& expected = one.margins.back();
    EXPECT_EQ(expected.verdict_name, gain < 1.0 ? "asymptotically_stable" : "unstable");
    ASSERT_GE(several.margins.size(), 2u);
    for (const state::StabilityMargin& margin : several.margins) {
      EXPECT_EQ(margin.verdict_name, expected.verdict_name) << margin.system;
      EXPECT_NEAR(margin.decay_rate, expected.decay_rate, 1e-9) << margin.system;
      EXPECT_EQ(margin.operating_point, std::vector<double>{0.0});
    }
    EXPECT_NE(several.margins.back().system, several.margins[several.margins.size() - 2].system);
    // Each controller's once a verdict, from one of the systems.
    ASSERT_GE(several.loop_margins.size(), 2u);
    EXPECT_EQ(several.loop_margins.size(), several.margins.size());
    for (std::size_t k = 1; k <= 2; ++k) {
      const state::ControllerMargins& found = several.loop_margins[several.loop_margins.size() - k];
      const state::ControllerMargins& of_one = one.loop_margins[one.loop_margins.size() - k];
      EXPECT_EQ(found.controller, of_one.controller);
      EXPECT_EQ(found.objection, "");
      EXPECT_EQ(found.zone, of_one.zone);
      if (gain < 1.0) {
        EXPECT_NEAR(found.sensitivity_peak, of_one.sensitivity_peak, 1e-9);
        EXPECT_NEAR(found.peak_frequency, of_one.peak_frequency, 1e-6);
      }
    }
  }
}

// An arm held aloft by its own motor, which the motor of a second one follows.
TEST(ClosedLoopEvaluation, EachSystemOfALoopIsJudgedWhereItIsHeld) {
  constexpr double kSetpoint = 1.0, kWeight = 10.0, kStiffness = 20.0, kRatio = 3.0;
  WatchedTwin watched(sceneOf(fmt::format(
      "{{step: 0.001, gravity: {0}, systems: {{leads: &arm {{model: pendulum, parameters: {{mass: "
      "1.0, length: 1.0, damping: 0.1}}, initial: {{theta: 1.0}}}}, follows: *arm}}, controllers: "
      "{{holds: "
      "{{type: pid, rate: 200.0, measures: [leads.theta], acts_on: [leads.torque], parameters: "
      "{{setpoint: {1}, kp: {2}, ki: 0.0, kd: 5.0}}}}, passes: {{type: pid, rate: 200.0, measures: "
      "[leads.theta], acts_on: [follows.torque], parameters: {{kp: {3}, ki: 0.0, kd: 0.0}}}}}}}}",
      kWeight, kSetpoint, kStiffness, -kRatio)));
  watched.run(0.5);
  double leads = kSetpoint;  // m g l sin(theta) = kp (setpoint - theta)
  for (int i = 0; i < 50; ++i) {
    leads -= (kWeight * std::sin(leads) - kStiffness * (kSetpoint - leads)) /
             (kWeight * std::cos(leads) + kStiffness);
  }
  const double follows = std::asin(kRatio * leads / kWeight);
  ASSERT_GE(watched.margins.size(), 2u);
  for (std::size_t k = 1; k <= 2; ++k) {
    const state::StabilityMargin& margin = watched.margins[watched.margins.size() - k];
    ASSERT_EQ(margin.operating_point.size(), 1u) << margin.system;
    EXPECT_NEAR(margin.operating_point[0], margin.system == "leads" ? leads : follows, 1e-9);
    EXPECT_EQ(margin.verdict_name, "asymptotically_stable");
  }
}

}  // namespace closed_loop_evaluation_test
}  // namespace whirl_twin

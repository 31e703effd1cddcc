// Equilibria under closed-loop control, and the stability of the loops there: where the twin
// settles, and where it diverges.
#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <vector>

#include "analysis/equilibria.h"
#include "analysis/sampled_stability.h"
#include "messages/input_error.h"
#include "scene/closed_loop.h"
#include "scene/closed_loop_equilibrium.h"
#include "scene/system_setup.h"
#include "scenes.h"
#include "twin/twin.h"

namespace whirl_twin {
namespace held_motion_test {

constexpr double kGravity = 9.81;

ClosedLoop::Parts partsOf(const Scene& scene) {
  return *closedLoops(scene).front().parts(
      [&](std::size_t system) { return motionAtStart(scene, system); }, 0.0);
}

SampledStability stabilityOf(const ClosedLoop::Parts& parts) {
  return sampledStability(sampledLoop(parts.plant, parts.controllers));
}

/// An arm of 1 kg and 1 m, held by a motor with kp = 7 N m/rad and an integral.
Scene arm(double start, double setpoint, double limit = 100.0) {
  return sceneOf(fmt::format(
      "{{step: 0.001, gravity: {}, systems: {{arm: {{model: pendulum, parameters: {{mass: 1.0, "
      "length: 1.0}}, initial: {{theta: {}}}}}}}, controllers: {{motor: {{type: pid, rate: 100.0, "
      "measures: [arm.theta], acts_on: [arm.torque], delay: 0.004, actuator: {{limit: {}}}, "
      "parameters: {{setpoint: {}, kp: 7.0, ki: 1.0, kd: 4.0}}}}}}}}",
      kGravity, start, limit, setpoint));
}

/// Places, then rates, of the scene's first system.
Eigen::VectorXd motionAfter(const Scene& scene, double seconds) {
  Twin twin(scene);
  while (twin.time() < seconds) {
    twin.step();
  }
  Eigen::VectorXd motion(2 * static_cast<Eigen::Index>(twin.running(0).dof()));
  twin.running(0).motion(motion.data());
  return motion;
}

// The weight's stiffness at 120 degrees takes 4.9 N m/rad off; upside down, the equilibrium next to
// the start, it would take 9.8, more than kp gives.
TEST(ClosedLoopEquilibrium, AnArmIsJudgedWhereItIsHeld) {
  const double setpoint = 2.0 * M_PI / 3.0;
  const Scene scene = arm(3.0, setpoint);
  const ClosedLoop::Parts parts = partsOf(scene);
  EXPECT_NEAR(parts.about.at(0).q[0], setpoint, 1e-9);
  EXPECT_NEAR(parts.outputs[0][0], kGravity * std::sin(setpoint), 1e-8);
  EXPECT_EQ(stabilityOf(parts).verdict, Verdict::kAsymptoticallyStable);
  EXPECT_NEAR(motionAfter(scene, 60.0)[0], setpoint, 1e-6);
}

TEST(ClosedLoopEquilibrium, OneThatIsTooWeakIsUnstableThere) {
  const Scene scene = arm(3.0, 3.05);
  const ClosedLoop::Parts parts = partsOf(scene);
  EXPECT_NEAR(parts.about.at(0).q[0], 3.05, 1e-9);
  EXPECT_EQ(stabilityOf(parts).verdict, Verdict::kUnstable);
  EXPECT_GT(std::fabs(motionAfter(scene, 5.0)[0] - 3.05), 0.3);
}

TEST(ClosedLoopEquilibrium, WhatAnActuatorCannotHoldIsSaid) {
  try {
    partsOf(arm(1.0, 1.5, 9.0));
    FAIL() << "an actuator of 9 N m does not hold 9.79";
  } catch (const RunFailure& failure) {
    EXPECT_THAT(
        failure.what(),
        testing::HasSubstr("arm.torque = 9.785 N m: the actuator of motor is limited to 9"));
  }
}

Scene governor(const std::string& gains) {
  return sceneOf(fmt::format(
      "{{step: 0.001, gravity: {}, systems: {{engine: {{model: governor, parameters: {{mass: 1.0, "
      "length: 0.25, inertia: 0.5, damping: 0.3, torque: 40.0, load: 20.0}}, initial: {{theta: "
      "1.0, phi_rate: 8.5}}}}}}, controllers: {{throttle: {{type: pid, rate: 200.0, measures: "
      "[engine.phi_rate], acts_on: [engine.torque], parameters: {}}}}}}}",
      kGravity, gains));
}

// Its balls are at cos theta = g / (l w^2).
TEST(ClosedLoopEquilibrium, AnEngineTurnsAsItIsHeld) {
  const ClosedLoop::Parts parts = partsOf(governor("{setpoint: 8.0, kp: 3.0, ki: 2.0, kd: 0.0}"));
  const ClosedLoopEquilibrium& held = parts.about.at(0);
  const double cosine = kGravity / (0.25 * 64.0);
  EXPECT_NEAR(held.q[0], std::acos(cosine), 1e-9);
  EXPECT_NEAR(held.v[1], 8.0, 1e-8);
  EXPECT_NEAR(held.inputs[0], 20.0 - 40.0 * cosine, 1e-7);
}

// A throttle with almost no effect: the loop is the self-oscillating engine alone.
TEST(ClosedLoopEquilibrium, ALoopThatDoesNothingIsItsPlant) {
  const Scene scene = governor("{setpoint: 8.0, kp: 1.0e-12, ki: 0.0, kd: 0.0}");
  const SystemSpec& engine = scene.systems[0];
  const Eigen::Vector2d q(1.0, 0.0), v(0.0, 8.5);
  const std::vector<Equilibrium> all = equilibria(*engine.setup->made.dynamics, 0.0, q, v);
  const auto alone = std::find_if(all.begin(), all.end(), [](const Equilibrium& motion) {
    return motion.q[0] > 0.0 && motion.v[1] > 0.0;
  });
  ASSERT_NE(alone, all.end());
  const ClosedLoop::Parts parts = partsOf(scene);
  EXPECT_NEAR(parts.about.at(0).v[1], alone->v[1], 1e-7);
  const SampledStability loop = stabilityOf(parts);
  EXPECT_EQ(loop.verdict, Verdict::kUnstable);
  EXPECT_NEAR(std::log(loop.spectral_radius) * 200.0, -alone->stability.decay_rate, 1e-7);
}

// A shaft in magnetic bearings under control without an integral: the sag, and so the magnets'
// forces, are those of the twin's equilibrium.
TEST(ClosedLoopEquilibrium, AShaftSagsInItsMagnetsAsItDoesInTheTwin) {
  const Scene scene = sceneOf(
      "{step: 0.001, gravity: 9.81, drives: {shaft: {speed: 0.0}}, systems: {rotor: {model: "
      "flexible_rotor, drive: shaft, parameters: {gravity_on_shaft: true, youngs_modulus: 2.1e11, "
      "density: 7800.0, elements: [{length: 0.1, outer_diameter: 0.025, count: 4}], discs: [{node: "
      "2, mass: 4.0, polar_inertia: 0.02, transverse_inertia: 0.011}], magnets: [{node: 0, ki: "
      "100.0, bias: 1.0, gap: 5.0e-4}, {node: 4, ki: 100.0, bias: 1.0, gap: 5.0e-4}], modes: 6, "
      "stations: [{node: 0}, {node: 4}]}}}, controllers: {magnets: {type: pid, rate: 10000.0, "
      "measures: [rotor.node_0.x, rotor.node_0.y, rotor.node_4.x, rotor.node_4.y], acts_on: "
      "[rotor.current_x_0, rotor.current_y_0, rotor.current_x_4, rotor.current_y_4], delay: "
      "5.0e-5, "
      "parameters: {kp: 6.0e3, ki: 0.0, kd: 8.0, derivative_time: 1.0e-4}}}}");
  const ClosedLoop::Parts parts = partsOf(scene);
  EXPECT_EQ(stabilityOf(parts).verdict, Verdict::kAsymptoticallyStable);
  const Eigen::VectorXd& held = parts.about.at(0).q;
  const Eigen::VectorXd settled = motionAfter(scene, 3.0).head(held.size());
  EXPECT_GT(settled.norm(), 5e-5);  // m
  EXPECT_LT((held - settled).norm(), 1e-6 * settled.norm());
  EXPECT_GT(std::fabs(parts.outputs[0][1]), 0.1);  // A
}

}  // namespace held_motion_test
}  // namespace whirl_twin

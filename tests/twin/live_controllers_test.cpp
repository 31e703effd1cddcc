// Parameters of controllers changed while the twin runs: bumpless, the set-point is tracked, values
// invalid in a scene are rejected, a reset restores the scene's; nothing is allocated in the loop.
#include <gtest/gtest.h>

#include <cmath>
#include <string>
#include <vector>

#include "allocation_guard.h"
#include "running_twin.h"

namespace whirl_twin {
namespace live_controllers_test {

/// A damped mass on a spring of 50 N/m, held 0.02 m away by a PID law: at rest u = 1 N, all of it
/// the integral's. And one on a spring alone.
const char* const kHeldMass = R"(
step: 0.001
systems:
  mass: {model: linear_system, parameters: {names: [x], mass: [[1.0]], damping: [[4.0]], stiffness: [[50.0]]}}
  other: {model: linear_system, parameters: {names: [x], mass: [[1.0]], stiffness: [[50.0]]}, initial: {x: 0.01}}
controllers:
  hold: {type: pid, rate: 200.0, measures: [mass.x], acts_on: [mass.force_x], delay: 0.003,
         parameters: {kp: 20.0, ki: 100.0, setpoint: 0.02}}
)";
constexpr double kPlace = 0.02;  // m
constexpr double kForce = 1.0;   // N

class LiveControllers : public testing::Test {
 protected:
  double place() { return twin.state(0)[0]; }
  double force() { return twin.observer.controller(0).output[0]; }
  double value(const std::string& name) {
    const state::ParameterChange& set = twin.observer.controllerParameters(0);
    const auto found = std::find(set.names.begin(), set.names.end(), name);
    return found == set.names.end()
               ? std::nan("")
               : set.values[static_cast<std::size_t>(found - set.names.begin())];
  }
  /// Continues, and returns the largest deviations of the force and the position.
  std::pair<double, double> largestChange(int steps, double force_then, double place_then) {
    std::pair<double, double> largest{0.0, 0.0};
    for (int i = 0; i < steps; ++i) {
      twin.cycle();
      twin.observe();
      largest.first = std::max(largest.first, std::fabs(force() - force_then));
      largest.second = std::max(largest.second, std::fabs(place() - place_then));
    }
    return largest;
  }

  Running twin{sceneOf(kHeldMass)};
};

TEST_F(LiveControllers, AtRestOtherGainsMoveNothing) {
  twin.cycle(30000);
  twin.observe();
  ASSERT_NEAR(force(), kForce, 1e-9);
  ASSERT_NEAR(place(), kPlace, 1e-10);
  for (const auto& [name, number] : {std::pair{"ki", 150.0}, {"kp", 35.0}, {"kd", 2.0}}) {
    const ParameterAnswer answer = twin.set("hold", name, number);
    ASSERT_TRUE(answer.done) << answer.message;
    const auto [force_off, place_off] = largestChange(500, kForce, kPlace);
    EXPECT_LT(force_off, 1e-8) << name;
    EXPECT_LT(place_off, 1e-10) << name;
    EXPECT_EQ(value(name), number);
  }
}

TEST_F(LiveControllers, TheMassGoesToAnotherSetPoint) {
  twin.cycle(10001);
  twin.observe();
  const std::vector<double> before = twin.state(0);
  twin.live.pause();
  twin.cycle();
  const ParameterAnswer answer = twin.set("hold", "setpoint", -0.01);
  ASSERT_TRUE(answer.done) << answer.message;
  EXPECT_EQ(answer.message, "hold.setpoint from 0.02 to -0.01");
  EXPECT_EQ(answer.previous, std::vector<double>{0.02});
  twin.observe();
  EXPECT_TRUE(twin.observer.tellsOnlyChange());
  EXPECT_EQ(twin.observer.step(), 10000);
  EXPECT_EQ(answer.step, 10000);
  EXPECT_EQ(twin.observer.controllerParameters(0).system, "hold");
  EXPECT_EQ(twin.observer.controllerParameters(0).changed, std::vector<std::string>{"setpoint"});
  EXPECT_EQ(twin.observer.controllerParameters(0).previous, std::vector<double>{0.02});
  EXPECT_EQ(twin.state(0), before) << "no jump";
  twin.command(TwinCommand::Kind::kResume);
  twin.cycle(30000);
  twin.observe();
  EXPECT_NEAR(place(), -0.01, 1e-9);
  EXPECT_NEAR(force(), -0.5, 1e-8);
  EXPECT_LT(std::fabs(twin.observer.energyResidual(0)), 1e-9);
}

TEST_F(LiveControllers, ASetPointMayGoInARamp) {
  twin.cycle(10000);
  ASSERT_TRUE(twin.set("hold", "setpoint", 0.04, 1.0).done);
  for (int i = 0; i < 500; ++i) {
    twin.cycle();
    twin.parameters.continueRamps();
  }
  twin.observe();
  EXPECT_NEAR(value("setpoint"), 0.03, 0.001);
  for (int i = 0; i < 600; ++i) {
    twin.cycle();
    twin.parameters.continueRamps();
  }
  twin.observe();
  EXPECT_EQ(value("setpoint"), 0.04);
  EXPECT_FALSE(twin.parameters.ramping());
}

TEST_F(LiveControllers, AResetBringsTheScenesParametersBack) {
  twin.cycle(1001);
  twin.observe();
  const double first = place();
  ASSERT_TRUE(twin.set("hold", "kp", 7.0).done);
  twin.cycle(50);
  twin.command(TwinCommand::Kind::kReset);
  twin.parameters.restored();
  twin.observe();
  EXPECT_EQ(value("kp"), 20.0);
  twin.cycle(1000);
  twin.observe();
  EXPECT_EQ(twin.observer.step(), 1000);
  EXPECT_EQ(place(), first);
  EXPECT_EQ(twin.set("hold", "kp", 7.0).previous, std::vector<double>{20.0});
}

TEST_F(LiveControllers, WhatASceneWouldRefuseIsRefusedInItsWords) {
  const std::string of = "set_parameter: controllers.hold.parameters.";
  const auto refused = [&](const std::string& name, double number) {
    const ParameterAnswer answer = twin.set("hold", name, number);
    EXPECT_FALSE(answer.done) << name;
    return answer.message;
  };
  EXPECT_EQ(refused("derivative_time", -1.0), of + "derivative_time: must be >= 0 s, found -1");
  EXPECT_EQ(refused("setpont", 1.0)
                .find(of + "setpont: unknown parameter of pid; did you mean 'setpoint'?"),
            0u);
  EXPECT_EQ(refused("anti_windup", 1.0),
            of + "anti_windup: is not a number: only numbers can be changed while the twin runs");
  EXPECT_EQ(refused("notch_rate", 300.0).find(of + "notch_rate: must be well below"), 0u);
  EXPECT_EQ(twin.set("hol", "kp", 1.0).message,
            "system: must be a system or a controller of the scene, found 'hol'; did you mean "
            "'hold'?");
  EXPECT_FALSE(twin.set("hold", "kp", std::nan("")).done);
}

TEST_F(LiveControllers, NothingIsAllocatedWhereALawIsExchanged) {
  twin.cycle(100);
  ChangedController next = withParameters(
      twin.live.twin().scene(), twin.live.twin().scene().controllers[0], {"kp"}, {30.0}, "test");
  const std::int64_t number =
      twin.live.generations()->add(2, SystemGeneration{nullptr, parametersOf(next.spec)});
  ASSERT_TRUE(twin.live.replaceLaw(0, next.law, number));
  {
    const AllocationGuard guard;
    twin.cycle(20);
    EXPECT_EQ(guard.allocations(), 0u);
  }
  twin.observe();
  EXPECT_EQ(value("kp"), 30.0);
}

TEST(LiveControllersOf, AnotherProcessHaveTheirParametersThere) {
  Running twin(sceneOf(
      "{step: 0.001, systems: {s: {model: linear_system, parameters: {names: [x], mass: "
      "[[1]], stiffness: [[1]]}}}, controllers: {far: {type: external, rate: 100, measures: "
      "[s.x], acts_on: [s.force_x], delay: 0.01, timeout: 0.5}}}"));
  EXPECT_EQ(
      twin.set("far", "timeout", 1.0).message,
      "set_parameter: controllers.far.parameters: must be changed in the controller's own process");
}

}  // namespace live_controllers_test
}  // namespace whirl_twin

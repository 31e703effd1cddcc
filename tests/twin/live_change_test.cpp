// Parameters changed while the twin runs: the motion continues without a jump, as in a twin that
// starts there with the new parameters; the energy audit continues too; nothing is allocated in the
// loop.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <memory>
#include <utility>

#include "allocation_guard.h"
#include "running_twin.h"

namespace whirl_twin {
namespace live_change_test {

TEST(LiveChange, IsARecordOfItsStepWithTheSameState) {
  Running twin(sceneOf(kTwoSystems));
  twin.cycle(501);
  twin.observe();
  const std::vector<double> before = twin.state(0);
  twin.live.pause();
  twin.cycle();
  const ParameterAnswer answer = twin.set("rotor", "damping", 25.0);
  ASSERT_TRUE(answer.done) << answer.message;
  EXPECT_EQ(answer.previous, std::vector<double>{kDamped});
  EXPECT_EQ(answer.step, 500);
  EXPECT_EQ(answer.message, "rotor.damping from 10 to 25");
  twin.observe();
  EXPECT_TRUE(twin.observer.tellsOnlyChange());
  EXPECT_EQ(twin.observer.step(), 500);
  EXPECT_EQ(twin.state(0), before) << "no jump";
  EXPECT_EQ(twin.value(0, "damping"), 25.0);
  EXPECT_EQ(twin.observer.parameters(0).changed, std::vector<std::string>{"damping"});
  EXPECT_EQ(twin.observer.parameters(0).previous, std::vector<double>{kDamped});
  EXPECT_EQ(twin.observer.generation(1), 0) << "the other system is what it was";
}

TEST(LiveChange, ParametersThatWouldStopASystemAreRefused) {
  Running twin(sceneOf(kTwoSystems));
  twin.cycle(10);
  for (const double length : {1e200, 1e-200}) {  // whose square is outside the range of a double
    const ParameterAnswer answer = twin.set("governor", "length", length);
    EXPECT_FALSE(answer.done) << length;
    EXPECT_NE(answer.message.find("governor"), std::string::npos) << answer.message;
  }
  EXPECT_FALSE(twin.set("rotor", "mass", 1e-300).done);
  ASSERT_TRUE(twin.set("governor", "length", 0.3).done);
  twin.cycle(1000);
  twin.observe();
  EXPECT_EQ(twin.observer.status(1), StepStatus::kOk);
}

TEST(LiveChange, SpeedsThatWouldStopASystemAreRefused) {
  Running twin(sceneOf(kTwoSystems));
  EXPECT_EQ(twin.parameters.speedDiagnostic(0, 50.0), "");
  const std::string refused = twin.parameters.speedDiagnostic(0, 1e6);
  EXPECT_EQ(refused.find("speed: at 1e+06 rad/s governor would stop in step "), 0u) << refused;
}

// A band of 40 to 60 rad/s, and 10 rad/s of run-up: from 38 rad/s it goes back to 30 before it
// crosses, and on to 70 before it returns to the edge.
TEST(LiveChange, AShaftSentIntoABandGoesToItsEdgePastWhatItTakes) {
  Running twin(sceneOf(
      "{step: 0.001, drives: {shaft: {speed: 38, avoid: {bands: [{from: 40, to: 60}]}}}, systems: "
      "{rotor: {model: jeffcott_rotor, drive: shaft, parameters: {mass: 2, stiffness: 800}}}}"));
  const SpeedMove move{51.0, 20.0, 20.0, 0.0};
  const SpeedReach reach = twin.parameters.reachOf(0, move).value();
  EXPECT_EQ(reach.target, 60.0);
  EXPECT_DOUBLE_EQ(reach.lowest, 30.0);
  EXPECT_DOUBLE_EQ(reach.highest, 70.0);
  ASSERT_TRUE(twin.parameters.prepareFor(0, move));
  TwinCommand command;
  command.kind = TwinCommand::Kind::kSetSpeed;
  command.speed = move.speed;
  command.max_acceleration = move.max_acceleration;
  command.max_jerk = move.max_jerk;
  ASSERT_TRUE(twin.live.send(command));
  {
    const AllocationGuard guard;
    twin.live.cycle(0);
    EXPECT_EQ(guard.allocations(), 0u);
  }
  ASSERT_TRUE(twin.live.answer().done);
  twin.cycle(static_cast<int>(1000.0 * twin.live.answer().duration) + 2);
  EXPECT_EQ(twin.live.twin().drive(0).at(0.0).speed, 60.0);
  twin.observe();
  EXPECT_EQ(twin.observer.status(0), StepStatus::kOk) << "it was ready for all of the way";
}

TEST(LiveChange, TheMotionGoesOnAsATwinThatStartsThereWithTheNewParameters) {
  Running twin(sceneOf(kTwoSystems));
  twin.cycle(731);
  ASSERT_TRUE(twin.set("rotor", "stiffness", 1.3e4).done);
  ASSERT_TRUE(twin.set("governor", "length", 0.25).done);
  twin.observe();
  const std::int64_t step = twin.observer.step();

  Scene scene = sceneOf(kTwoSystems);
  scene.time = step * scene.step;
  scene.systems[0].parameters["stiffness"] = 1.3e4;
  scene.systems[0].parameters["stiffness_y"] = 1.3e4;  // which the scene leaves to follow it
  scene.systems[1].parameters["length"] = 0.25;
  for (std::size_t i = 0; i < 2; ++i) {
    const std::vector<double> state = twin.state(i);
    const std::size_t n = state.size() / 2;
    scene.systems[i].q.assign(state.begin(), state.begin() + static_cast<std::ptrdiff_t>(n));
    scene.systems[i].v.assign(state.begin() + static_cast<std::ptrdiff_t>(n), state.end());
  }
  Running fresh(scene);
  fresh.cycle(1001);
  fresh.observe();
  twin.cycle(1000);
  twin.observe();
  ASSERT_EQ(twin.observer.step(), step + 1000);
  for (std::size_t i = 0; i < 2; ++i) {
    for (std::size_t k = 0; k < twin.state(i).size(); ++k) {
      // The shaft's angle, counted from another start, is rounded otherwise: by 3e-15 rad.
      EXPECT_NEAR(twin.state(i)[k], fresh.state(i)[k], 1.0e-13) << i << ", " << k;
    }
  }
}

// The change itself does work (a spring made stiffer while it is bent): no residual may show it.
TEST(LiveChange, TheEnergyAuditGoesOnWithTheNewParameters) {
  Running twin(sceneOf(kTwoSystems));
  twin.cycle(300);
  for (const auto& [name, value] : {std::pair{"stiffness", 2.0e4},
                                    {"eccentricity", 5.0e-4},
                                    {"mass", 3.0},
                                    {"damping", 40.0}}) {
    ASSERT_TRUE(twin.set("rotor", name, value).done);
    twin.cycle(500);
  }
  EXPECT_LT(twin.observe(0), 1.0e-9);
  ASSERT_TRUE(twin.set("governor", "mass", 2.0, 0.3).done);
  for (int i = 0; i < 500; ++i) {
    twin.cycle();
    twin.parameters.continueRamps();
  }
  EXPECT_LT(twin.observe(1), 1.0e-9);
  EXPECT_EQ(twin.value(1, "mass"), 2.0);
}

TEST(LiveChange, SeveralParametersChangeAtTheSameInstant) {
  Running twin(sceneOf(kTwoSystems));
  twin.cycle(10);
  const ParameterAnswer answer =
      twin.parameters.set({"rotor", {"stiffness", "stiffness_y"}, {2.0e4, 2.0e4}, 0.0});
  ASSERT_TRUE(answer.done) << answer.message;
  twin.observe();
  EXPECT_EQ(twin.value(0, "stiffness"), 2.0e4);
  EXPECT_EQ(twin.value(0, "stiffness_y"), 2.0e4);
  EXPECT_EQ(twin.observer.parameters(0).changed,
            (std::vector<std::string>{"stiffness", "stiffness_y"}));
}

TEST(LiveChange, ARampIsLinearInSimulatedTimeAndEndsExactly) {
  Running twin(sceneOf(kTwoSystems));
  twin.cycle(101);  // t = 0.1 s
  const ParameterAnswer answer = twin.set("rotor", "damping", 30.0, 0.5);
  ASSERT_TRUE(answer.done);
  EXPECT_EQ(answer.message, "rotor.damping from 10 to 30 in 0.5 s");
  double before = kDamped;
  for (int i = 0; i < 700; ++i) {
    twin.cycle();
    EXPECT_TRUE(twin.parameters.continueRamps().empty());
    twin.observe();
    const double time = twin.observer.moment(0).time;
    const double expected = kDamped + 20.0 * std::clamp((time - 0.1) / 0.5, 0.0, 1.0);
    const double now = twin.value(0, "damping");
    // One update late, and the cycles that the swap itself took.
    EXPECT_NEAR(now, expected, 20.0 * (LiveParameters::kRampUpdate + 0.003) / 0.5);
    EXPECT_GE(now, before);
    before = now;
  }
  EXPECT_EQ(twin.value(0, "damping"), 30.0);
  EXPECT_FALSE(twin.parameters.ramping());
  EXPECT_LT(twin.observe(0), 1.0e-9);
}

TEST(LiveChange, InAPauseARampStandsStillAndAChangeIsTold) {
  Running twin(sceneOf(kTwoSystems));
  twin.cycle(10);
  ASSERT_TRUE(twin.set("rotor", "damping", 30.0, 0.1).done);
  twin.live.pause();
  for (int i = 0; i < 200; ++i) {
    twin.cycle();
    twin.parameters.continueRamps();
  }
  EXPECT_TRUE(twin.parameters.ramping());
  ASSERT_TRUE(twin.set("rotor", "mass", 2.0).done);
  twin.observe();
  EXPECT_EQ(twin.value(0, "mass"), 2.0);
  EXPECT_EQ(twin.value(0, "damping"), kDamped);
}

TEST(LiveChange, AResetBringsBackTheScenesParameters) {
  Running twin(sceneOf(kTwoSystems));
  twin.cycle(100);
  ASSERT_TRUE(twin.set("rotor", "damping", 50.0).done);
  ASSERT_TRUE(twin.set("governor", "length", 0.4, 10.0).done);
  twin.cycle(100);
  twin.command(TwinCommand::Kind::kReset);
  twin.parameters.restored();
  EXPECT_FALSE(twin.parameters.ramping());
  twin.cycle(300);
  twin.observe();
  EXPECT_EQ(twin.value(0, "damping"), kDamped);
  EXPECT_TRUE(twin.observer.parameters(0).changed.empty());
  Running fresh(sceneOf(kTwoSystems));
  fresh.cycle(static_cast<int>(twin.observer.step()) + 1);
  fresh.observe();
  EXPECT_EQ(twin.state(0), fresh.state(0));
  EXPECT_EQ(twin.state(1), fresh.state(1));
  // And it can be changed again.
  const ParameterAnswer answer = twin.set("rotor", "damping", 11.0);
  ASSERT_TRUE(answer.done);
  EXPECT_EQ(answer.previous, std::vector<double>{kDamped});
}

TEST(LiveChange, TheSwapAllocatesNothingInTheLoop) {
  LiveTwin live(sceneOf(kTwoSystems), 10000);
  std::vector<std::unique_ptr<Stepper>> next;
  for (int i = 0; i < 20; ++i) {
    const SharedSystem changed =
        live.twin().systems()[0]->with({"damping"}, {10.0 + i}, "set_parameter");
    live.generations()->add(0, {changed->dynamics, {}});
    next.push_back(live.twin().stepperOf(*changed));
  }
  for (std::size_t i = 0; i < next.size(); ++i) {
    ASSERT_TRUE(live.replace(0, next[i], static_cast<std::int64_t>(i) + 1));
    EXPECT_EQ(next[i], nullptr);
    const AllocationGuard guard;
    for (int k = 0; k < 50; ++k) {
      live.cycle(k);
    }
    EXPECT_EQ(guard.allocations(), 0u);
    EXPECT_EQ(live.carriedOut(), live.sent());
  }
  TwinCommand reset;
  reset.kind = TwinCommand::Kind::kReset;
  ASSERT_TRUE(live.send(reset));
  const AllocationGuard guard;
  live.cycle(0);
  live.cycle(1);
  EXPECT_EQ(guard.allocations(), 0u);
}

TEST(LiveChange, WhatTheLoopNeverTookIsDeleted) {
  auto live = std::make_unique<LiveTwin>(sceneOf(kTwoSystems), 100);
  std::unique_ptr<Stepper> next = live->twin().stepperOf(*live->twin().systems()[0]);
  ASSERT_TRUE(live->replace(0, next, 1));
  std::unique_ptr<Stepper> second = live->twin().stepperOf(*live->twin().systems()[0]);
  EXPECT_FALSE(live->replace(0, second, 2)) << "another is under way";
  EXPECT_NE(second, nullptr);
  live.reset();  // leaks are seen by the sanitizer's build
}

}  // namespace live_change_test
}  // namespace whirl_twin

// A system with controllers is judged as they sample it.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <memory>

#include "monitoring/system_judge.h"
#include "scene/built_scene.h"
#include "scene/changed_controller.h"
#include "watched_twin.h"

namespace whirl_twin {
namespace {

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
  SystemJudge judge(scene.systems[0],
                    std::make_shared<const ClosedLoop>(closedLoops(scene.scene)[0]));
  return judge.judge({5, 0.005, 0}, {1.0e-3}, {0.0}, 0.0);
}

TEST(ClosedLoopJudge, WhatIsUnstableByItselfIsStableWithItsController) {
  const BuiltScene scene = levitated(0.1);
  EXPECT_EQ(SystemJudge(scene.systems[0]).judge({5, 0.005, 0}, {1.0e-3}, {0.0}, 0.0).verdict_name,
            "unstable");
  const state::StabilityMargin margin = judged(scene);
  EXPECT_EQ(margin.verdict_name, "asymptotically_stable");
  EXPECT_EQ(margin.right, 0u);
  EXPECT_EQ(margin.polynomial.size(), margin.left + 1u);
  // Spectral radius 0.926013966 a sample of 0.1 s.
  EXPECT_NEAR(margin.decay_rate, -std::log(0.926013966) / 0.1, 1e-7);
  EXPECT_FALSE(margin.routh_disagrees);
}

TEST(ClosedLoopJudge, TooLateItIsUnstable) {
  const state::StabilityMargin margin = judged(levitated(0.7));
  EXPECT_EQ(margin.verdict_name, "unstable");
  EXPECT_GT(margin.right, 0u);
  EXPECT_LT(margin.decay_rate, 0.0);
}

// kp = 0.9 is less than the magnet's negative stiffness.
TEST(ClosedLoopJudge, VerdictAndMarginsFollowTheParametersOfAController) {
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

}  // namespace
}  // namespace whirl_twin

// Judgements beside the alarms: each about the newest state, none mixed up with a reset.
#include "monitoring/judging.h"

#include <gtest/gtest.h>

#include <cmath>
#include <thread>

#include "watched_twin.h"

namespace whirl_twin {
namespace judging_test {

constexpr const char* kTwoRotors = R"(
name: two
step: 0.001
drives: {shaft: {speed: 150.0}}
systems:
  first:
    model: jeffcott_rotor
    drive: shaft
    parameters: {mass: 1.0, stiffness: 1.0e4, damping: 10.0, internal_damping: 10.0}
  second:
    model: jeffcott_rotor
    drive: shaft
    parameters: {mass: 1.0, stiffness: 1.0e4, damping: 10.0}
)";

/// The first with its speeds, and what went before it.
std::vector<Judgement> awaited(Judging& judging) {
  std::vector<Judgement> all;
  while (all.empty() || !all.back().speeds) {
    for (Judgement& judgement : judging.take()) {
      all.push_back(std::move(judgement));
    }
    std::this_thread::yield();
  }
  return all;
}

TEST(Judging, BesideItJudgesAsAtOnce) {
  const BuiltScene scene = build(sceneOf(kTwoRotors));
  Judging at_once(scene.systems, Judging::Mode::kAtOnce);
  Judging beside(scene.systems, Judging::Mode::kBeside);
  for (const std::size_t system : {0u, 1u}) {
    for (const double speed : {150.0, 210.0}) {
      const JudgementRequest request{
          system, scene.systems[system], {7, 0.007, 0}, {0.0, 0.0}, {0.0, 0.0}, speed, 3};
      at_once.ask(request);
      beside.ask(request);
      const std::vector<Judgement> expected = at_once.take();
      ASSERT_EQ(expected.size(), 1u);
      for (const Judgement& found : awaited(beside)) {
        EXPECT_EQ(found.system, system);
        EXPECT_EQ(found.run, 3u);
        EXPECT_EQ(found.margin.at.step, 7);
        EXPECT_EQ(found.margin.verdict_name, expected[0].margin.verdict_name);
        EXPECT_EQ(found.margin.decay_rate, expected[0].margin.decay_rate);
        if (system == 0 && found.speeds) {
          EXPECT_EQ(found.speeds->thresholds.lowest(), expected[0].speeds->thresholds.lowest());
        }
        EXPECT_GE(found.margin.age, 0.0);
      }
    }
  }
}

// Unstable above 100 (1 + 10/10) rad/s, with twice the internal damping above 150.
TEST(Judging, TheVerdictOnNewParametersGoesBeforeTheirSpeeds) {
  const BuiltScene scene = build(sceneOf(kTwoRotors));
  Judging judging(scene.systems, Judging::Mode::kBeside);
  const SharedSystem changed = scene.systems[0]->with({"internal_damping"}, {20.0}, "test");
  judging.ask({0, changed, {7, 0.007, 0}, {0.0, 0.0}, {0.0, 0.0}, 160.0, 0});
  const std::vector<Judgement> found = awaited(judging);
  ASSERT_EQ(found.size(), 2u);
  for (const Judgement& judgement : found) {
    EXPECT_EQ(judgement.margin.verdict_name, "unstable");
    EXPECT_EQ(judgement.margin.at.step, 7);
    EXPECT_EQ(judgement.built, changed);
  }
  EXPECT_FALSE(found[0].speeds);
  EXPECT_TRUE(found[0].margin.critical_speeds.empty());
  EXPECT_TRUE(std::isnan(found[0].margin.instability_speed)) << "those of before are not told";
  EXPECT_NEAR(found[1].margin.instability_speed, 150.0, 1.0e-9);
  EXPECT_EQ(found[1].margin.critical_speeds.size(), 1u);
  // Known from now on: one verdict, with them.
  judging.ask({0, changed, {8, 0.008, 0}, {0.0, 0.0}, {0.0, 0.0}, 140.0, 0});
  EXPECT_EQ(awaited(judging).size(), 1u);
}

/// States keep coming while the first verdict on new parameters, and then their speeds, are made:
/// each judgement is about one of them, with all its coordinates.
TEST(Judging, AStateThatComesMeanwhileIsJudgedWhole) {
  // A linear system's operating point would be found from any state, an empty one too.
  const BuiltScene scene = build(sceneOf(R"(
step: 0.001
systems:
  arm:
    model: pendulum
    parameters: {mass: 1.0, length: 0.5, damping: 0.1}
)"));
  for (int changes = 0; changes < 10; ++changes) {
    Judging judging(scene.systems, Judging::Mode::kBeside);
    const SharedSystem changed =
        scene.systems[0]->with({"damping"}, {0.2 + 0.01 * changes}, "test");
    std::size_t judged = 0;
    bool with_speeds = false;
    for (std::int64_t step = 1; !with_speeds || judged < 20; ++step) {
      const double time = 0.001 * static_cast<double>(step);
      judging.ask({0, changed, {step, time, 0}, {0.1}, {0.0}, 0.0, 3});
      for (const Judgement& judgement : judging.take()) {
        ASSERT_EQ(judgement.margin.operating_point.size(), 1u);
        ASSERT_EQ(judgement.margin.verdict_name, "asymptotically_stable");
        ASSERT_LE(judgement.margin.at.step, step);
        with_speeds = with_speeds || judgement.speeds.has_value();
        ++judged;
      }
      std::this_thread::yield();
    }
  }
}

TEST(Judging, AllSystemsHaveTheirTurnAndTheNewestStateIsJudgedLast) {
  const BuiltScene scene = build(sceneOf(kTwoRotors));
  Judging judging(scene.systems, Judging::Mode::kBeside);
  for (std::int64_t step = 1; step <= 1000; ++step) {
    for (const std::size_t system : {0u, 1u}) {
      judging.ask({system, scene.systems[system], {step, 0.0, 0}, {0, 0}, {0, 0}, 150.0, 0});
    }
  }
  std::int64_t last[2] = {0, 0};
  while (last[0] < 1000 || last[1] < 1000) {
    for (const Judgement& judgement : judging.take()) {
      EXPECT_GE(judgement.margin.at.step, last[judgement.system]);
      last[judgement.system] = judgement.margin.at.step;
    }
    std::this_thread::yield();
  }
}

// A rotor on its motor: what it operates about is picked from what is known, and is the same as if
// all were found anew.
TEST(Judging, AFreeSpinRotorIsJudgedAboutTheMotionThatAFullSearchFinds) {
  const BuiltScene scene = build(sceneOf(R"(
name: free_rotor
step: 0.001
systems:
  weak:
    model: free_rotor
    parameters: {mass: 2.0, stiffness: 200.0, damping: 2.0, eccentricity: 0.01, polar_inertia: 0.02, torque: 0.03}
    initial: {spin_rate: 2.0}
)"));
  const BuiltSystem& system = *scene.systems[0];
  SystemJudge judge(scene.systems[0]);
  double time = 0.0;
  for (const double rate : {2.0, 5.0, 9.0, 9.05, 30.0, 80.0, 140.0, 12.0}) {
    time += 2.0;
    const Eigen::Vector3d q(0.001, -0.001, 0.3);
    const Eigen::Vector3d v(0.0, 0.0, rate);
    const auto margin = judge.judge({0, time, 0}, {q[0], q[1], q[2]}, {v[0], v[1], v[2]}, 0.0);
    const auto expected = operatingPoint(*system.dynamics, q, v, 0.0);
    ASSERT_TRUE(expected);
    EXPECT_NEAR(margin.operating_point[0], expected->q[0], 1.0e-9) << rate;
    EXPECT_NEAR(margin.operating_point[1], expected->q[1], 1.0e-9) << rate;
    EXPECT_NEAR(margin.decay_rate, expected->stability.decay_rate, 1.0e-6) << rate;
  }
}

}  // namespace judging_test
}  // namespace whirl_twin

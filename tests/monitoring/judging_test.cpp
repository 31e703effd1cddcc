// Judgements beside the alarms: each about the newest state, none mixed up with a reset.
#include "monitoring/judging.h"

#include <gtest/gtest.h>

#include <thread>

#include "watched_twin.h"

namespace whirl_twin {
namespace {

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

std::vector<Judgement> awaited(Judging& judging, std::size_t count) {
  std::vector<Judgement> all;
  while (all.size() < count) {
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
      const std::vector<Judgement> found = awaited(beside, 1);
      ASSERT_EQ(expected.size(), 1u);
      EXPECT_EQ(found[0].system, system);
      EXPECT_EQ(found[0].run, 3u);
      EXPECT_EQ(found[0].margin.at.step, 7);
      EXPECT_EQ(found[0].margin.verdict_name, expected[0].margin.verdict_name);
      EXPECT_EQ(found[0].margin.decay_rate, expected[0].margin.decay_rate);
      if (system == 0) {
        EXPECT_EQ(found[0].speeds.thresholds.lowest(), expected[0].speeds.thresholds.lowest());
      }
      EXPECT_GE(found[0].margin.age, 0.0);
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
      EXPECT_GT(judgement.margin.at.step, last[judgement.system]);
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
  SystemJudge judge(system);
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

}  // namespace
}  // namespace whirl_twin

// Judgements beside the alarms: each about the newest state, none mixed up with a reset.
#include "monitoring/evaluation_queue.h"

#include <gtest/gtest.h>

#include <cmath>
#include <thread>

#include "watched_twin.h"

namespace whirl_twin {
namespace evaluation_queue_test {

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
std::vector<StabilityResult> awaited(EvaluationQueue& queue) {
  std::vector<StabilityResult> all;
  while (all.empty() || !all.back().speeds) {
    for (StabilityResult& result : queue.take()) {
      all.push_back(std::move(result));
    }
    std::this_thread::yield();
  }
  return all;
}

TEST(EvaluationQueue, BesideItJudgesAsAtOnce) {
  const BuiltScene scene = build(sceneOf(kTwoRotors));
  EvaluationQueue at_once(scene.systems, EvaluationQueue::Mode::kAtOnce);
  EvaluationQueue beside(scene.systems, EvaluationQueue::Mode::kConcurrent);
  for (const std::size_t system : {0u, 1u}) {
    for (const double speed : {150.0, 210.0}) {
      const EvaluationRequest request{
          system, scene.systems[system], {7, 0.007, 0}, {0.0, 0.0}, {0.0, 0.0}, speed, 3};
      at_once.add(request);
      beside.add(request);
      const std::vector<StabilityResult> expected = at_once.take();
      ASSERT_EQ(expected.size(), 1u);
      for (const StabilityResult& found : awaited(beside)) {
        EXPECT_EQ(found.request.system, system);
        EXPECT_EQ(found.request.run, 3u);
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
TEST(EvaluationQueue, TheVerdictOnNewParametersGoesBeforeTheirSpeeds) {
  const BuiltScene scene = build(sceneOf(kTwoRotors));
  EvaluationQueue queue(scene.systems, EvaluationQueue::Mode::kConcurrent);
  const SharedSystem changed = scene.systems[0]->with({"internal_damping"}, {20.0}, "test");
  queue.add({0, changed, {7, 0.007, 0}, {0.0, 0.0}, {0.0, 0.0}, 160.0, 0});
  const std::vector<StabilityResult> found = awaited(queue);
  ASSERT_EQ(found.size(), 2u);
  for (const StabilityResult& result : found) {
    EXPECT_EQ(result.margin.verdict_name, "unstable");
    EXPECT_EQ(result.margin.at.step, 7);
    EXPECT_EQ(result.request.built, changed);
  }
  EXPECT_FALSE(found[0].speeds);
  EXPECT_TRUE(found[0].margin.critical_speeds.empty());
  EXPECT_TRUE(std::isnan(found[0].margin.instability_speed)) << "those of before are not told";
  EXPECT_NEAR(found[1].margin.instability_speed, 150.0, 1.0e-9);
  EXPECT_EQ(found[1].margin.critical_speeds.size(), 1u);
  // Known from now on: one verdict, with them.
  queue.add({0, changed, {8, 0.008, 0}, {0.0, 0.0}, {0.0, 0.0}, 140.0, 0});
  EXPECT_EQ(awaited(queue).size(), 1u);
}

/// States keep coming while the first verdict on new parameters, and then their speeds, are made:
/// each result is about one of them, with all its coordinates.
TEST(EvaluationQueue, AStateThatComesMeanwhileIsJudgedWhole) {
  // A linear system's operating point would be found from any state, an empty one too.
  const BuiltScene scene = build(sceneOf(R"(
step: 0.001
systems:
  arm:
    model: pendulum
    parameters: {mass: 1.0, length: 0.5, damping: 0.1}
)"));
  for (int changes = 0; changes < 10; ++changes) {
    EvaluationQueue queue(scene.systems, EvaluationQueue::Mode::kConcurrent);
    const SharedSystem changed =
        scene.systems[0]->with({"damping"}, {0.2 + 0.01 * changes}, "test");
    std::size_t judged = 0;
    bool with_speeds = false;
    for (std::int64_t step = 1; !with_speeds || judged < 20; ++step) {
      const double time = 0.001 * static_cast<double>(step);
      queue.add({0, changed, {step, time, 0}, {0.1}, {0.0}, 0.0, 3});
      for (const StabilityResult& result : queue.take()) {
        ASSERT_EQ(result.margin.operating_point.size(), 1u);
        ASSERT_EQ(result.margin.verdict_name, "asymptotically_stable");
        ASSERT_LE(result.margin.at.step, step);
        with_speeds = with_speeds || result.speeds.has_value();
        ++judged;
      }
      std::this_thread::yield();
    }
  }
}

TEST(EvaluationQueue, AllSystemsHaveTheirTurnAndTheNewestStateIsJudgedLast) {
  const BuiltScene scene = build(sceneOf(kTwoRotors));
  EvaluationQueue queue(scene.systems, EvaluationQueue::Mode::kConcurrent);
  for (std::int64_t step = 1; step <= 1000; ++step) {
    for (const std::size_t system : {0u, 1u}) {
      queue.add({system, scene.systems[system], {step, 0.0, 0}, {0, 0}, {0, 0}, 150.0, 0});
    }
  }
  std::int64_t last[2] = {0, 0};
  while (last[0] < 1000 || last[1] < 1000) {
    for (const StabilityResult& result : queue.take()) {
      EXPECT_GE(result.margin.at.step, last[result.request.system]);
      last[result.request.system] = result.margin.at.step;
    }
    std::this_thread::yield();
  }
}

// A rotor on its motor: its steady motion is one of the known ones, and the same as a new search
// finds.
TEST(EvaluationQueue, AFreeSpinRotorIsJudgedAboutTheMotionThatAFullSearchFinds) {
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
  StabilityEvaluator evaluator(scene.systems[0]);
  double time = 0.0;
  for (const double rate : {2.0, 5.0, 9.0, 9.05, 30.0, 80.0, 140.0, 12.0}) {
    time += 2.0;
    const Eigen::Vector3d q(0.001, -0.001, 0.3);
    const Eigen::Vector3d v(0.0, 0.0, rate);
    const auto margin =
        evaluator.evaluate({0, time, 0}, {q[0], q[1], q[2]}, {v[0], v[1], v[2]}, 0.0);
    const auto expected = operatingPoint(*system.dynamics, q, v, 0.0);
    ASSERT_TRUE(expected);
    EXPECT_NEAR(margin.operating_point[0], expected->q[0], 1.0e-9) << rate;
    EXPECT_NEAR(margin.operating_point[1], expected->q[1], 1.0e-9) << rate;
    EXPECT_NEAR(margin.decay_rate, expected->stability.decay_rate, 1.0e-6) << rate;
  }
}

}  // namespace evaluation_queue_test
}  // namespace whirl_twin

// The margins that are searched beside the verdicts.
#include <gtest/gtest.h>

#include <cmath>
#include <string>
#include <thread>

#include "monitoring/evaluation_queue.h"
#include "watched_twin.h"

namespace whirl_twin {
namespace stability_boundary_search_test {

// Unstable above 100 (1 + 10/10) = 200 rad/s; cross-coupling of 20 * 100 - 10 w brings it there.
constexpr const char* kSelfExcited = R"(
name: self_excited
step: 0.001
drives: {shaft: {speed: 150.0}}
systems:
  rotor:
    model: jeffcott_rotor
    drive: shaft
    parameters: {mass: 1.0, stiffness: 1.0e4, damping: 10.0, internal_damping: 10.0}
)";

StabilityResult judged(const SharedSystem& system, double time, double speed) {
  StabilityEvaluator evaluator(system);
  StabilityResult result;
  result.request.built = system;
  result.request.speed = speed;
  result.margin = evaluator.evaluate({0, time, 0}, {0.0, 0.0}, {0.0, 0.0}, speed);
  result.motion = evaluator.motion();
  return result;
}

/// The verdict at a time, evaluated again until the search beside it has ended.
StabilityResult found(StabilityBoundarySearch& search, const SharedSystem& system, double time,
                      double speed) {
  StabilityResult result = judged(system, time, speed);
  search.addTo(result, 0.0);
  while (result.margin.nearest_time != time) {
    std::this_thread::yield();
    result = judged(system, time, speed);
    search.addTo(result, 0.0);
  }
  return result;
}

TEST(StabilityBoundarySearch, BesideTheVerdictsFindsWhatItFindsAtOnce) {
  const BuiltScene scene = build(sceneOf(kSelfExcited));
  for (const EvaluationQueue::Mode mode :
       {EvaluationQueue::Mode::kAtOnce, EvaluationQueue::Mode::kConcurrent}) {
    StabilityBoundarySearch search(1, mode);
    const state::StabilityMargin margin = found(search, scene.systems[0], 1.0, 150.0).margin;
    EXPECT_EQ(margin.nearest_parameter, "speed");
    EXPECT_NEAR(margin.nearest_change, 1.0 / 3.0, 1.0e-8);
    EXPECT_NEAR(margin.nearest_value, 200.0, 1.0e-6);
    EXPECT_EQ(margin.nearest_loss, "whirl");
    EXPECT_NEAR(margin.nearest_frequency, 100.0, 1.0e-4);
    EXPECT_NEAR(margin.cross_coupling_margin, 500.0, 1.0e-6);
  }
}

TEST(StabilityBoundarySearch, SaysUpToWhichAmplitudeTheDecrementHolds) {
  const BuiltScene linear = build(sceneOf(kSelfExcited));
  StabilityBoundarySearch search(1, EvaluationQueue::Mode::kAtOnce);
  const state::StabilityMargin any = found(search, linear.systems[0], 1.0, 150.0).margin;
  EXPECT_EQ(any.log_decrement_coordinate, "whirl");
  EXPECT_TRUE(std::isinf(any.log_decrement_amplitude));
  std::string stator = kSelfExcited;
  stator.insert(stator.rfind('}'), ", rub_stiffness: 4.0e+5, rub_clearance: 2.0e-4");
  const BuiltScene rub = build(sceneOf(stator.c_str()));
  StabilityBoundarySearch other(1, EvaluationQueue::Mode::kAtOnce);
  const state::StabilityMargin narrow = found(other, rub.systems[0], 1.0, 150.0).margin;
  EXPECT_GE(narrow.log_decrement_amplitude, 2.0e-4 * (1.0 - 1.0e-9));
  EXPECT_LT(narrow.log_decrement_amplitude, 2.2e-4);
}

TEST(StabilityBoundarySearch, TellsNothingOfOtherParametersThanItHasSearched) {
  const BuiltScene scene = build(sceneOf(kSelfExcited));
  StabilityBoundarySearch search(1, EvaluationQueue::Mode::kConcurrent);
  found(search, scene.systems[0], 1.0, 150.0);
  // With 6 N s/m along x it is unstable where (6 + 10) (10 + 10) = (10 w / 100)^2.
  const SharedSystem changed =
      scene.systems[0]->with({"damping", "damping_y"}, {6.0, 10.0}, "test");
  StabilityResult first = judged(changed, 1.1, 150.0);
  search.addTo(first, 0.0);
  EXPECT_TRUE(first.margin.nearest_parameter.empty() || first.margin.nearest_time == 1.1);
  const state::StabilityMargin margin = found(search, changed, 1.1, 150.0).margin;
  EXPECT_EQ(margin.nearest_parameter, "speed");
  EXPECT_NEAR(margin.nearest_value, 10.0 * std::sqrt(320.0), 1.0e-6);
}

TEST(StabilityBoundarySearch, LooksAnewWhereTheSpeedHasChangedButNotAllTheTime) {
  const BuiltScene scene = build(sceneOf(kSelfExcited));
  StabilityBoundarySearch search(1, EvaluationQueue::Mode::kAtOnce);
  const auto at = [&](double time, double speed) {
    StabilityResult result = judged(scene.systems[0], time, speed);
    search.addTo(result, 0.0);
    return result.margin;
  };
  EXPECT_EQ(at(0.0, 100.0).nearest_time, 0.0);
  EXPECT_EQ(at(0.5, 150.0).nearest_time, 0.0) << "within a second";
  EXPECT_EQ(at(1.0, 150.0).nearest_time, 1.0);
  EXPECT_EQ(at(9.0, 150.5).nearest_time, 1.0) << "the same speed, but for a hundredth";
  const state::StabilityMargin unstable = at(10.0, 250.0);
  EXPECT_EQ(unstable.nearest_parameter, "") << "it has lost it already";
  EXPECT_TRUE(std::isnan(unstable.nearest_change));
  EXPECT_EQ(at(0.2, 150.0).nearest_time, 0.2) << "a log that is played a second time";
}

TEST(StabilityBoundarySearch, IsPartOfTheMonitor) {
  WatchedTwin watched(sceneOf(kSelfExcited));
  watched.run(0.15);
  ASSERT_FALSE(watched.margins.empty());
  EXPECT_EQ(watched.margins.back().nearest_parameter, "speed");
  EXPECT_NEAR(watched.margins.back().cross_coupling_margin, 500.0, 1.0e-6);
  EXPECT_FALSE(watched.margins.back().routh_disagrees);
}

}  // namespace stability_boundary_search_test
}  // namespace whirl_twin

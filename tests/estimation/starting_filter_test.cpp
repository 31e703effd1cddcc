// A filter with a poor initial estimate that iterates its initialization: its uncertainty is
// consistent.
#include <gtest/gtest.h>

#include <Eigen/LU>
#include <cmath>
#include <random>

#include "estimation/iterated_initializer.h"
#include "scene/scene_reader.h"
#include "twin/twin.h"

namespace whirl_twin {
namespace starting_filter_test {

constexpr double kNoise = 0.002;  // rad
constexpr double kLength = 0.3, kDamping = 0.004;

BuiltScene armWith(double length, double damping) {
  BuiltScene scene = build(readScene(YAML::Load(R"(
name: rig
step: 0.001
systems:
  arm:
    model: pendulum
    parameters: {mass: 0.5, length: 0.3, damping: 0.004}
    initial: {theta: 1.2}
)"),
                                     "a test"));
  scene.systems[0] = scene.systems[0]->with({"length", "damping"}, {length, damping}, "a test");
  return scene;
}

/// Normalized squared errors of the parameters: 2 on the mean (chi-squared of two degrees of
/// freedom).
struct Squares {
  double parameters = 0.0;
  double largest_off = 0.0;  // of the length, in parts
};

/// Tracks a swing of six seconds at 500 Hz from parameters drawn from the prior: 10 % of the
/// length, half of the damping.
template <class Filter>
Squares afterASwing(unsigned seed) {
  std::mt19937 random(seed);
  std::normal_distribution<double> normal;
  const double length = 0.1 * normal(random), damping = 0.5 * normal(random);
  SystemFollowing settings;
  settings.parameters = {{"length", {0.1, 0.0}}, {"damping", {0.5, 0.0}}};
  EstimatorChannel encoder;
  encoder.name = "encoder/theta";
  encoder.signal.unit = "rad";
  encoder.deviation = kNoise;
  Filter filter(armWith(kLength * std::exp(length), kDamping * std::exp(damping)), 0, settings,
                {encoder});
  Twin machine(armWith(kLength, kDamping));
  std::vector<double> record(machine.layout().size);
  filter.begin({0, {}, 0.0});
  while (machine.stepCount() < 6000) {
    machine.step();
    if (machine.stepCount() % 2 == 0) {
      machine.write(record.data());
      filter.goTo({machine.stepCount() * 1'000'000, {}, 0.0});
      filter.take(0, machine.layout().system(record.data(), 0).q()[0] + kNoise * normal(random));
    }
  }
  const Eigen::Vector2d error =
      filter.filter().state().template segment<2>(2) + Eigen::Vector2d(length, damping);
  const Eigen::Matrix2d p = filter.filter().covariance().template block<2, 2>(2, 2);
  return {error.dot(p.inverse() * error), std::fabs(error[0])};
}

TEST(IteratedInitializer, ThatBeginsFarOffKnowsHowCertainItIs) {
  constexpr int kRuns = 20;
  double looked_again = 0.0, once = 0.0, largest = 0.0;
  for (unsigned seed = 1; seed <= kRuns; ++seed) {
    const Squares again = afterASwing<IteratedInitializer>(seed);
    looked_again += again.parameters / kRuns;
    largest = std::max(largest, again.largest_off);
    once += afterASwing<ExtendedKalmanFilter>(seed).parameters / kRuns;
  }
  EXPECT_NEAR(looked_again, 2.0, 5.0 * 2.0 / std::sqrt(kRuns));
  EXPECT_LT(largest, 2.0e-3);
  EXPECT_GT(once, 2.0 * looked_again) << "what a second look is for";
}

/// One with a good prior skips the iteration.
TEST(IteratedInitializer, ThatKnowsEnoughKeepsNothing) {
  SystemFollowing settings;
  settings.parameters = {{"length", {0.01, 0.0}}, {"damping", {0.1, 0.0}}};
  IteratedInitializer filter(armWith(kLength, kDamping), 0, settings, {});
  filter.begin({0, {}, 0.0});
  EXPECT_FALSE(filter.looksAtItsStart());
}

}  // namespace starting_filter_test
}  // namespace whirl_twin

// An observer that looks only as often as it says it must tells the same phases as one that looks
// at every step.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <cmath>
#include <cstdint>
#include <random>
#include <string>
#include <vector>

#include "../scene/scenes.h"
#include "twin/observer.h"

namespace whirl_twin {
namespace {

struct Comparison {
  std::int64_t steps = 0;
  std::int64_t looks = 0;
  double largest_difference = 0.0;  // rad
};

Comparison compare(const Scene& scene, std::int64_t steps) {
  Twin twin(scene);
  Observer every(twin);
  Observer sparse(twin);
  std::vector<double> record(twin.layout().size);
  Comparison c;
  for (c.steps = 1; c.steps <= steps; ++c.steps) {
    twin.step();
    twin.write(record.data());
    every.observe(record.data());
    if (!sparse.mustSee(record.data())) {
      continue;
    }
    sparse.observe(record.data());
    ++c.looks;
    const double difference = std::fabs(every.whirlPhase(0) - sparse.whirlPhase(0));
    if (!std::isnan(difference)) {
      c.largest_difference = std::max(c.largest_difference, difference);
    }
    EXPECT_EQ(std::isnan(every.whirlPhase(0)), std::isnan(sparse.whirlPhase(0)));
  }
  return c;
}

TEST(SparseObservation, PhasesOfRandomRotorsAreUnwrappedAlike) {
  std::mt19937_64 random(12);
  const auto between = [&](double low, double high) {
    return std::uniform_real_distribution<double>(low, high)(random);
  };
  for (int trial = 0; trial < 60; ++trial) {
    const double target = between(-300.0, 300.0);
    const std::string text = fmt::format(
        "{{step: {}, drives: {{d: {{speed: {}, profile: [{{speed: {}, max_acceleration: {}}}]}}}}, "
        "systems: {{rotor: {{model: jeffcott_rotor, drive: d, parameters: {{mass: 2, "
        "stiffness: {}, stiffness_y: {}, damping: {}, eccentricity: {}, internal_damping: {}}}, "
        "initial: {{x: {}, y: {}, x_rate: {}, y_rate: {}}}}}}}}}",
        trial % 3 == 0 ? 0.0001 : 0.001, between(-300.0, 300.0), target, between(10.0, 500.0),
        between(500.0, 80000.0), between(500.0, 80000.0), between(0.0, 20.0),
        trial % 4 == 0 ? 0.0 : between(0.0, 1e-3), trial % 5 == 0 ? 3.0 : 0.0, between(-1e-3, 1e-3),
        trial % 2 == 0 ? 0.0 : between(-1e-3, 1e-3), trial % 2 == 0 ? 0.0 : between(-0.1, 0.1),
        between(-0.1, 0.1));
    const Comparison c = compare(sceneOf(text), 20'000);
    EXPECT_LT(c.largest_difference, 1e-9) << text;
    EXPECT_GT(c.looks, 0);
  }
}

// Of steps of a millisecond, at 60 rad/s, five may go by.
TEST(SparseObservation, SteadyWhirlIsLookedAtOnlyNowAndThen) {
  const Scene scene = sceneOf(
      "{step: 0.001, systems: {rotor: {model: jeffcott_rotor, parameters: {mass: 2, "
      "stiffness: 7200, damping: 120, eccentricity: 1e-4, speed: 60}}}}");
  const Comparison c = compare(scene, 20'000);
  EXPECT_LT(c.largest_difference, 1e-9);
  EXPECT_LT(c.looks, 20'000 / 4);
}

TEST(SparseObservation, PendulumsHaveNoPhaseToFollow) {
  const Scene scene = sceneOf(
      "{step: 0.001, systems: {p: {model: double_pendulum, parameters: {mass1: 1, mass2: 1, "
      "length1: 1, "
      "length2: 1}, initial: {theta1: 1}}}}");
  const Twin twin(scene);
  EXPECT_EQ(Observer(twin).mayPass(), 64);
}

}  // namespace
}  // namespace whirl_twin

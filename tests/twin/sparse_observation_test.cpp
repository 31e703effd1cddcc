// An observer that publishes few steps, and only samples those between, publishes the same phases
// as one that observes every step, bit-identical. Where a whirl loses its phase, near 1e-9 of the
// largest radius so far, one may keep it a step longer than the other, which found a larger radius:
// afterwards they agree up to whole turns.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <random>
#include <string>
#include <vector>

#include "../scene/scenes.h"
#include "twin/observer.h"

namespace whirl_twin {
namespace sparse_observation_test {

struct Comparison {
  std::int64_t observed = 0;  ///< steps, of the unpublished ones
  std::int64_t looked = 0;
  int differing = 0;  ///< published phases
};

class Same {
 public:
  /// Called for every step, published or not: sparse samples may miss the largest.
  void see(double radius) { largest_ = std::max(largest_, radius); }
  bool operator()(const state::WhirlState& a, const state::WhirlState& b) {
    ended_ = ended_ || a.radius < 4e-9 * largest_;
    if (std::isnan(a.phase) || std::isnan(b.phase)) {
      return ended_ || (std::isnan(a.phase) && std::isnan(b.phase));
    }
    const double turn = 2.0 * 3.14159265358979323846;
    return ended_ ? std::abs(std::remainder(a.phase - b.phase, turn)) < 1e-9 : a.phase == b.phase;
  }

 private:
  double largest_ = 0.0;  // [m]
  bool ended_ = false;
};

/// Publishes every `stride`-th step, and observes those that are required, with records and
/// without.
Comparison compare(const Scene& scene, std::int64_t steps, std::int64_t stride) {
  Twin twin(scene);
  Observer every(twin);
  Observer sparse(twin);
  Observer records(twin);
  std::vector<double> record(twin.layout().size);
  std::vector<Same> same(every.stations(0).size());
  Comparison c;
  for (std::int64_t i = 1; i <= steps; ++i) {
    twin.step();
    twin.write(record.data());
    every.observe(record.data());
    for (std::size_t k = 0; k < same.size(); ++k) {
      same[k].see(every.whirl(0, k).radius);
    }
    if (i % stride == 0 || !records.look(record.data())) {
      records.observe(record.data());
      c.differing += same[0](every.whirl(0), records.whirl(0)) ? 0 : 1;
    }
    const bool due = i % stride == 0 || i - sparse.step() >= sparse.mostPassed();
    if (!due) {
      if (sparse.look(twin)) {
        ++c.looked;
        continue;
      }
      ++c.observed;
    }
    sparse.observe(record.data());
    for (std::size_t k = 0; k < every.stations(0).size(); ++k) {
      c.differing += same[k](every.whirl(0, k), sparse.whirl(0, k)) ? 0 : 1;
    }
  }
  return c;
}

class Random {
 public:
  double between(double low, double high) {
    return std::uniform_real_distribution<double>(low, high)(generator_);
  }
  bool once_in(int count) { return std::uniform_int_distribution<int>(1, count)(generator_) == 1; }
  double zero_once_in(int count, double low, double high) {
    return once_in(count) ? 0.0 : between(low, high);
  }

 private:
  std::mt19937_64 generator_{12};
};

/// Run-ups, run-downs, reversals, stationary shafts and constant speeds; free whirls faster and
/// slower than the shaft, in a plane and around the centre, about a sag and without; steps in which
/// they turn by a hundredth of a turn and by more than half.
std::string randomRotor(Random& random) {
  const double speed = random.zero_once_in(4, -300.0, 300.0);
  const double target = random.zero_once_in(4, -300.0, 300.0);
  const bool constant = random.once_in(2);
  const bool isotropic = random.once_in(2);
  const double stiffness = random.between(500.0, 80000.0);
  return fmt::format(
      "{{gravity: 9.81, step: {}, drives: {{d: {{speed: {}{}}}}}, systems: {{rotor: {{model: "
      "jeffcott_rotor, drive: d, parameters: {{gravity_on_shaft: {}, mass: 2, stiffness: {}, "
      "stiffness_y: {}, damping: {}, eccentricity: {}, internal_damping: {}, phase_mark: {}}}, "
      "initial: {{x: {}, y: {}, x_rate: {}, y_rate: {}}}}}}}}}",
      random.once_in(4) ? 0.01 : 0.001, speed,
      constant ? ""
               : fmt::format(", profile: [{{speed: {}, max_acceleration: {}, dwell: 2}}]", target,
                             random.between(10.0, 500.0)),
      random.once_in(3), stiffness, isotropic ? stiffness : random.between(500.0, 80000.0),
      random.zero_once_in(3, 0.0, 20.0), random.zero_once_in(4, 0.0, 1e-3),
      random.once_in(5) ? 3.0 : 0.0, random.between(-3.0, 3.0), random.between(-1e-3, 1e-3),
      random.zero_once_in(2, -1e-3, 1e-3), random.zero_once_in(2, -0.1, 0.1),
      random.between(-0.1, 0.1));
}

TEST(SparseObservation, PhasesOfRandomRotorsAreUnwrappedAlike) {
  Random random;
  Comparison all;
  for (int trial = 0; trial < 150; ++trial) {
    const std::string text = randomRotor(random);
    const Comparison c = compare(sceneOf(text), 10'000, trial % 2 == 0 ? 997 : 10'000);
    EXPECT_EQ(c.differing, 0) << text;
    all.looked += c.looked;
    all.observed += c.observed;
  }
  EXPECT_GT(all.looked, 500'000);
  EXPECT_GT(all.observed, 0);
}

// Within a step the shaft turns by nearly a quarter of a turn, and gets there within a few steps.
TEST(SparseObservation, ShaftsThatTurnFarInAStepAreFollowed) {
  std::int64_t looked = 0;
  for (const double stiffness : {5.0, 100.0, 400.0}) {
    for (const double acceleration : {220.0, 250.0, 280.0, 800.0}) {
      for (const double jerk : {350.0, 416.67, 500.0, 9000.0}) {
        for (const double start : {0.0, 4.0, 9.0, -150.0}) {
          const std::string text = fmt::format(
              "{{step: 0.01, drives: {{shaft: {{speed: {}, profile: [{{speed: 150, "
              "max_acceleration: {}, max_jerk: {}}}]}}}}, systems: {{rotor: {{model: "
              "jeffcott_rotor, drive: shaft, integrator: exponential, parameters: {{mass: 1, "
              "stiffness: {}, damping: 0, eccentricity: 1e-4}}, initial: {{x: 0.005, y_rate: "
              "0.1}}}}}}}}",
              start, acceleration, jerk, stiffness);
          const Comparison c = compare(sceneOf(text), 400, 20'000);
          EXPECT_EQ(c.differing, 0) << text;
          looked += c.looked;
        }
      }
    }
  }
  EXPECT_GT(looked, 1'000);
}

TEST(SparseObservation, EveryStationOfAShaftIsFollowed) {
  const std::string shaft =
      "systems: {rotor: {model: flexible_rotor, drive: d, parameters: {youngs_modulus: 2.1e11, "
      "shear_modulus: 8.1e10, density: 7800, "
      "elements: [{length: 0.2, outer_diameter: 0.03, count: 6}], "
      "discs: [{node: 2, mass: 5, polar_inertia: 0.02, transverse_inertia: 0.012}, "
      "{node: 4, mass: 3, polar_inertia: 0.01, transverse_inertia: 0.006}], "
      "bearings: [{node: 0, kxx: 1e6, kyy: 2e6, cxx: 200, cyy: 200}, "
      "{node: 6, kxx: 1e6, kyy: 2e6, cxx: 200, cyy: 200}], "
      "unbalances: [{node: 2, magnitude: 1e-4, angle: 0.3}], "
      "stations: [{node: 4}, {node: 3}, {node: 0}], modes: 6, highest_speed: 400}}}}";
  for (const char* drive : {"speed: 300", "speed: 0, profile: [{speed: 400, max_acceleration: 60}]",
                            "speed: 100, profile: [{speed: -100, max_acceleration: 50}]"}) {
    const Comparison c = compare(
        sceneOf(fmt::format("{{step: 0.001, drives: {{d: {{{}}}}}, ", drive) + shaft), 8'000, 1999);
    EXPECT_EQ(c.differing, 0) << drive;
  }
}

// Energies are published: their largest value in play is tracked all the same.
TEST(SparseObservation, EnergiesAreObservedNowAndThen) {
  const Twin pendulum(sceneOf(
      "{step: 0.001, systems: {p: {model: double_pendulum, parameters: {mass1: 1, mass2: 1, "
      "length1: 1, length2: 1}, initial: {theta1: 1}}}}"));
  EXPECT_EQ(Observer(pendulum).mostPassed(), 64);
  const Twin rotor(
      sceneOf("{step: 0.001, systems: {rotor: {model: jeffcott_rotor, parameters: {mass: 2, "
              "stiffness: 7200, speed: 60}}}}"));
  EXPECT_EQ(Observer(rotor).mostPassed(), 512);
}

// The running estimate of a rotor that rubs, which is found in one step of 64.
TEST(SparseObservation, AnErrorIsSeenInTheStepThatFindsIt) {
  Twin twin(sceneOf(
      "{step: 0.001, systems: {rotor: {model: jeffcott_rotor, parameters: {mass: 2, "
      "stiffness: 2.0e4, damping: 10, eccentricity: 1e-4, speed: 80, rub_clearance: 1.0e-4, "
      "rub_stiffness: 4.0e5, rub_friction: 0.1, rotor_radius: 0.05}}}}"));
  Observer every(twin);
  Observer sparse(twin);
  std::vector<double> record(twin.layout().size);
  int found = 0;
  for (int i = 0; i < 5'000; ++i) {
    const double before = every.errorEstimate(0);
    twin.step();
    twin.write(record.data());
    every.observe(record.data());
    if (!sparse.look(twin)) {
      sparse.observe(record.data());
    }
    if (every.errorEstimate(0) > before) {
      ++found;
      EXPECT_EQ(sparse.step(), twin.stepCount());
      EXPECT_NEAR(sparse.errorEstimate(0), every.errorEstimate(0), 1e-9 * every.errorEstimate(0));
    }
  }
  EXPECT_GT(found, 5);
}

}  // namespace sparse_observation_test
}  // namespace whirl_twin

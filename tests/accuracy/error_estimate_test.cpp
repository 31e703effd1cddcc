// The running error estimate of the twin against the true error, for every engine.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <ostream>
#include <random>
#include <string>
#include <vector>

#include "../scene/scenes.h"
#include "accuracy/step_choice.h"
#include "independent_motion.h"
#include "twin/observer.h"
#include "twin/twin.h"

namespace whirl_twin {
namespace error_estimate_test {

constexpr double kHorizon = 4.0;  // s

struct Case {
  const char* name;
  const char* system;  // YAML, without its integrator
  const char* integrator;
  const char* step;  // [s]
  double most = 20.0;
};

void PrintTo(const Case& c, std::ostream* out) {
  *out << c.name;
}

constexpr const char* kSwing =
    "model: double_pendulum, parameters: {mass1: 1, mass2: 1, length1: 1, length2: 1}, "
    "initial: {theta1: 0.4, theta2: 0.3}";
constexpr const char* kSpin =
    "model: spinning_pendulum, parameters: {mass: 1, length: 1, damping: 0.02, speed: 5}, "
    "initial: {theta: 0.5}";
constexpr const char* kWhirl =
    "model: jeffcott_rotor, parameters: {mass: 1, stiffness: 100, damping: 0.4, speed: 8, "
    "eccentricity: 0.001}, initial: {x: 0.01}";

class ErrorEstimate : public testing::TestWithParam<Case> {
 protected:
  Scene scene() const {
    const Case& c = GetParam();
    return sceneOf(std::string("{step: ") + c.step + ", systems: {one: {" + c.system +
                   ", horizon: 4.0, integrator: " + c.integrator + "}}}");
  }
};

TEST_P(ErrorEstimate, IsThatOfTheHorizonWithinItsSize) {
  const Scene one = scene();
  Twin twin(one);
  Observer observer(twin);
  std::vector<double> record(twin.layout().size);
  while (twin.time() < kHorizon) {
    twin.step();
    twin.write(record.data());
    observer.observe(record.data());
  }
  constexpr std::int64_t kInterval = 40'000'000;  // [ns]
  const auto samples = static_cast<std::size_t>(1e9 * kHorizon / kInterval) + 1;
  const IndependentMotion truth = independentMotion(one, kInterval, samples, 1.0e6);
  ASSERT_LT(truth.own.position(samples - 1), 1e-12);
  const double error =
      ErrorCurve(motion(one, kInterval, samples), truth.trajectory).position(samples - 1);
  ASSERT_GT(error, 1e-11) << "rounding: a coarser step is wanted";
  // Errors of single steps partly cancel, so that their sum exceeds the global error; the sum over
  // a time constant of one horizon is 1 - 1/e of that over the horizon. The errors of a method with
  // a long step history are high derivatives, mostly of overtones, which cancel better.
  EXPECT_GT(observer.errorEstimate(0), 0.5 * error) << error;
  EXPECT_LT(observer.errorEstimate(0), GetParam().most * error) << error;
}

INSTANTIATE_TEST_SUITE_P(
    Methods, ErrorEstimate,
    testing::Values(Case{"SwingByEuler", kSwing, "semi_implicit_euler", "0.002"},
                    Case{"SwingByVerlet", kSwing, "velocity_verlet", "0.004"},
                    Case{"SwingByMidpoint", kSwing, "implicit_midpoint", "0.004"},
                    Case{"SwingByRungeKutta", kSwing, "runge_kutta_4", "0.004"},
                    Case{"SwingByGaussLegendre", kSwing, "gauss_legendre_6", "0.02"},
                    Case{"SwingByStoermer6", kSwing, "stoermer_6", "0.01", 200.0},
                    Case{"SpinByStoermer6", kSpin, "stoermer_6", "0.01", 200.0},
                    Case{"SpinByStoermer", kSpin, "stoermer", "0.02", 200.0},
                    Case{"SpinAhead", kSpin, "stoermer_ahead, substeps: 5", "0.004", 200.0},
                    Case{"SpinByVerlet", kSpin, "velocity_verlet", "0.004"},
                    Case{"SpinByRungeKutta", kSpin, "runge_kutta_4", "0.004"},
                    Case{"SpinByGaussLegendre4", kSpin, "gauss_legendre_4", "0.004"},
                    Case{"WhirlByVerlet", kWhirl, "velocity_verlet", "0.004"},
                    Case{"WhirlByRungeKutta", kWhirl, "runge_kutta_4", "0.004"},
                    Case{"WhirlByGaussLegendre6", kWhirl, "gauss_legendre_6", "0.02"}),
    [](const auto& test) { return test.param.name; });

TEST(ErrorEstimateOf, TheExactStepIsRounding) {
  Twin twin(sceneOf(std::string("{step: 0.001, systems: {one: {") + kWhirl + "}}}"));
  ASSERT_EQ(twin.systems()[0]->integrator, "exponential");
  Observer observer(twin);
  std::vector<double> record(twin.layout().size);
  for (int i = 0; i < 10000; ++i) {
    twin.step();
    twin.write(record.data());
    observer.observe(record.data());
  }
  EXPECT_LT(observer.errorEstimate(0), 1e-11);  // 1e4 steps, some 1e-16 each
}

TEST(ErrorEstimateOf, AResetTwinStartsAnew) {
  Twin twin(sceneOf(std::string("{step: 0.01, systems: {one: {") + kSwing +
                    ", integrator: velocity_verlet}}}"));
  Observer observer(twin);
  std::vector<double> record(twin.layout().size);
  const auto run = [&](int steps) {
    for (int i = 0; i < steps; ++i) {
      twin.step();
      twin.write(record.data());
      observer.observe(record.data());
    }
    return observer.errorEstimate(0);
  };
  const double first = run(200);
  EXPECT_GT(first, 0.0);
  twin.reset();
  EXPECT_GT(run(1), 0.0) << "no run is too short";
  EXPECT_NEAR(run(199), first, 1e-12 * first);
}

/// The largest estimate of a scene's one system over a time [s], from its first step on.
double largestEstimate(const Scene& one, double duration) {
  Twin twin(one);
  Observer observer(twin);
  std::vector<double> record(twin.layout().size);
  double largest = 0.0;
  while (twin.time() < duration) {
    twin.step();
    twin.write(record.data());
    observer.observe(record.data());
    largest = std::max(largest, observer.errorEstimate(0));
  }
  return largest;
}

// A tolerance that `auto` meets is never reported as lost: in the first steps a rate is a
// thousandth of its later value, and its error was taken relative to that.
TEST(ErrorEstimateOf, AMotionFromRestInFrictionIsWithinTheToleranceThatIsKept) {
  std::mt19937 random(7);
  std::uniform_real_distribution<double> uniform;
  int kept = 0;
  for (int draw = 0; draw < 24; ++draw) {
    const double coulomb = 0.02 * std::pow(20.0, uniform(random));
    const double angle = 0.3 + 2.0 * uniform(random);
    const char* const step = draw % 3 == 0 ? "0.0002" : "0.001";
    const std::string system =
        draw % 2 == 0 ? fmt::format(
                            "model: pendulum, parameters: {{mass: 1, length: 0.5, coulomb: "
                            "{}}}, initial: {{theta: {}}}",
                            coulomb, angle)
                      : fmt::format(
                            "model: double_pendulum, parameters: {{mass1: 1, mass2: 1, "
                            "length1: 1, length2: 1, coulomb1: {}, coulomb2: {}}}, "
                            "initial: {{theta1: {}, theta2: {}}}",
                            coulomb, coulomb, angle, 0.5 * angle);
    const Scene one = sceneOf(fmt::format("{{step: {}, systems: {{one: {{{}}}}}}}", step, system));
    const StepChoice choice = chooseStep(one);
    if (!choice.promise.kept) {
      continue;
    }
    ++kept;
    const double largest =
        largestEstimate(withSetting(one, {choice.integrator, one.step, choice.substeps}), 2.0);
    EXPECT_LT(largest, 1.0e-6) << system << ", " << choice.reason;
  }
  EXPECT_GT(kept, 12);
}

// A bob that hangs still until it is pushed starts from rest in the midst of a run.
TEST(ErrorEstimateOf, AMotionThatSetsInLaterIsThatOfOneThatSetsInAtTheStart) {
  const auto estimate = [](double begin) {
    Scene one = sceneOf(
        "{step: 0.004, systems: {one: {model: pendulum, parameters: {mass: 1, length: 0.5}, "
        "integrator: runge_kutta_4, horizon: 4.0}}}");
    InputSignal& torque = one.systems.front().inputs["torque"];
    torque.kind = InputSignal::Kind::kTable;
    torque.hold = true;
    torque.instants = {0, std::llround(1e9 * begin)};
    torque.values = {0.0, 1.5};
    return largestEstimate(one, begin + 3.0);
  };
  const double late = estimate(2.004);
  EXPECT_LT(late, 4.0 * estimate(0.004));
  EXPECT_GT(late, 0.25 * estimate(0.004));
}

/// The estimate and the true error of a scene's one system after a second.
struct Estimated {
  double estimate, error;
};

Estimated estimated(const Scene& one) {
  Twin twin(one);
  twin.buildEnsembles();
  Observer observer(twin);
  std::vector<double> record(twin.layout().size);
  while (twin.time() < 1.0) {
    twin.step();
    twin.write(record.data());
    observer.observe(record.data());
  }
  const std::int64_t interval = std::max<std::int64_t>(one.step, 10'000'000);
  const auto samples = static_cast<std::size_t>(1'000'000'000 / interval) + 1;
  const IndependentMotion truth = independentMotion(one, interval, samples, 1.0e6);
  return {observer.errorEstimate(0),
          ErrorCurve(motion(one, interval, samples), truth.trajectory).position(samples - 1)};
}

constexpr const char* kRunUp =
    "drives: {shaft: {speed: 0, profile: [{speed: 250, max_acceleration: 500, dwell: 1}]}}, "
    "systems: {one: {model: jeffcott_rotor, drive: shaft, parameters: {mass: 2, stiffness: 2.0e4, "
    "damping: 10, eccentricity: 1.0e-4";

constexpr const char* kByTable = ", internal_damping: 6}, inputs: {force_x: 0.0}}}}";

// The table over speed neglects the change of speed inside a step: 0.02 s are coarse.
TEST(ErrorEstimateOf, ARotorSteppedFromATableOverSpeed) {
  const Estimated coarse = estimated(sceneOf(std::string("{step: 0.02, ") + kRunUp + kByTable));
  ASSERT_GT(coarse.error, 1e-6);
  EXPECT_GT(coarse.estimate, 0.3 * coarse.error) << coarse.error;
  EXPECT_LT(coarse.estimate, 50.0 * coarse.error) << coarse.error;
  const Estimated fine = estimated(sceneOf(std::string("{step: 0.001, ") + kRunUp + kByTable));
  EXPECT_LT(fine.estimate, 1e-6);
}

TEST(ErrorEstimateOf, ALinearSystem) {
  const std::string system =
      "{step: 0.01, systems: {one: {model: linear_system, parameters: {mass: [[1, 0], [0, 2]], "
      "stiffness: [[30, -10], [-10, 20]]}, initial: {q1: 0.1}, integrator: ";
  const Estimated rough = estimated(sceneOf(system + "implicit_midpoint}}}"));
  ASSERT_GT(rough.error, 1e-5);
  EXPECT_GT(rough.estimate, 0.3 * rough.error) << rough.error;
  EXPECT_LT(rough.estimate, 20.0 * rough.error) << rough.error;
  EXPECT_LT(estimated(sceneOf(system + "exponential}}}")).estimate, 1e-12);
}

TEST(ErrorEstimateOf, TheMembersOfAnEnsemble) {
  const std::string swing =
      "{step: 0.01, systems: {one: {model: spinning_pendulum, integrator: velocity_verlet, "
      "parameters: {mass: 1, length: 1, speed: 1}, initial: {theta: 1.0e-3}, "
      "count: 20, spread: {initial.theta: {half_width: 1.0}}}}}";
  EXPECT_GT(estimated(sceneOf(swing)).estimate, 5e-6) << "the system itself swings by a hair";
  // Side by side in vectors: exact, at any step.
  const Estimated rotors = estimated(sceneOf(std::string("{step: 0.02, ") + kRunUp +
                                             "}, count: 100, spread: {stiffness: "
                                             "{relative_half_width: 0.1}}}}}"));
  EXPECT_GT(rotors.estimate, 0.0);
}

}  // namespace error_estimate_test
}  // namespace whirl_twin

// The error that the twin estimates while it runs, against the true one; and where it estimates
// none.
#include <gtest/gtest.h>

#include <cmath>
#include <ostream>
#include <string>
#include <vector>

#include "../scene/scenes.h"
#include "accuracy/reference_trajectory.h"
#include "twin/observer.h"
#include "twin/twin.h"

namespace whirl_twin {
namespace {

constexpr double kHorizon = 4.0;  // s

struct Case {
  const char* name;
  const char* system;  // YAML, without its integrator
  const char* integrator;
  const char* step;  // [s]
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
  const auto duration = static_cast<std::int64_t>(1e9 * kHorizon);
  const Trajectory own = trajectory(one, duration, kInterval);
  const ReferenceTrajectory reference =
      referenceTrajectory(one, "gauss_legendre_6", duration, kInterval, 1e-13);
  const double error =
      trajectoryError(own, reference.trajectory, reference.trajectory.samples()).position;
  ASSERT_GT(error, 1e-12) << "rounding: a coarser step is wanted";
  // Errors of single steps partly cancel, so that their sum is more than what is left; the
  // sum over a time constant of one horizon is 1 - 1/e of that over the horizon.
  EXPECT_GT(observer.errorEstimate(0), 0.5 * error) << error;
  EXPECT_LT(observer.errorEstimate(0), 20.0 * error) << error;
}

INSTANTIATE_TEST_SUITE_P(
    Methods, ErrorEstimate,
    testing::Values(Case{"SwingByEuler", kSwing, "semi_implicit_euler", "0.002"},
                    Case{"SwingByVerlet", kSwing, "velocity_verlet", "0.004"},
                    Case{"SwingByMidpoint", kSwing, "implicit_midpoint", "0.004"},
                    Case{"SwingByRungeKutta", kSwing, "runge_kutta_4", "0.004"},
                    Case{"SwingByGaussLegendre", kSwing, "gauss_legendre_6", "0.02"},
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
  EXPECT_EQ(run(10), 0.0) << "none of these was taken twice";
  EXPECT_NEAR(run(190), first, 1e-12 * first);
}

TEST(ErrorEstimateOf, ARotorGivenByMatricesIsNotMade) {
  Twin twin(sceneOf(R"(
{step: 0.001, drives: {shaft: {speed: 10}}, systems: {one: {model: jeffcott_rotor, drive: shaft,
 parameters: {mass: 1, stiffness: 1.0e4, damping: 10, internal_damping: 5}}}}
)"));
  Observer observer(twin);
  std::vector<double> record(twin.layout().size);
  twin.step();
  twin.write(record.data());
  observer.observe(record.data());
  EXPECT_TRUE(std::isnan(observer.errorEstimate(0)));
}

}  // namespace
}  // namespace whirl_twin

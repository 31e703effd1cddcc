// The threshold speed of a rotor's instability from the growth of its whirl in time: it agrees with
// the formula, Routh's test and the eigenvalues (catalogue, "named whirl causes").
#include <gtest/gtest.h>

#include <cmath>
#include <complex>

#include "analysis/instability_speed.h"
#include "running_system.h"

namespace whirl_twin {
namespace threshold_growth_test {

struct Cause {
  const char* name;
  ParameterValues effects;
  double threshold;  // [rad/s], by formula
};

constexpr double kMass = 2.0;      // [kg]
constexpr double kP = 300.0;       // [rad/s]
constexpr double kDamping = 24.0;  // [N s/m]

RunningSystem::Setup rotor(const Cause& cause, double speed) {
  RunningSystem::Setup setup;
  setup.model = "jeffcott_rotor";
  setup.parameters = cause.effects;
  setup.parameters["mass"] = kMass;
  setup.parameters["stiffness"] = kMass * kP * kP;
  setup.parameters["damping"] = kDamping;
  setup.speed = speed;
  setup.q = {1.0e-4, 0.0};
  setup.v = {0.0, 1.0e-4 * kP};
  return setup;
}

/// [1/s], of the forward whirl, from its size at two instants; steps of 5 ms.
double growth(const Cause& cause, double speed) {
  RunningSystem run(rotor(cause, speed), "exponential", 5'000'000);
  const auto forward = [&run] {
    // z' = i w z forwards, - i w z backwards, w close to p.
    const std::complex<double> z(run.q(0), run.q(1));
    const std::complex<double> rate(run.v(0), run.v(1));
    return 0.5 * std::abs(z - std::complex<double>(0.0, 1.0 / kP) * rate);
  };
  EXPECT_EQ(run.run(400), StepStatus::kOk);  // the backward whirl has gone
  const double first = forward();
  const double from = run.time();
  EXPECT_EQ(run.run(400), StepStatus::kOk);
  return std::log(forward() / first) / (run.time() - from);
}

class Threshold : public testing::TestWithParam<Cause> {};

TEST_P(Threshold, IsOneByFormulaByRouthAndByGrowthInTime) {
  const Cause& cause = GetParam();
  double low = 0.9 * cause.threshold;
  double high = 1.1 * cause.threshold;
  ASSERT_LT(growth(cause, low), 0.0);
  ASSERT_GT(growth(cause, high), 0.0);
  while (high - low > 1.0e-8 * high) {
    const double middle = 0.5 * (low + high);
    (growth(cause, middle) < 0.0 ? low : high) = middle;
  }
  EXPECT_NEAR(low / cause.threshold, 1.0, 1.0e-6);

  const RunningSystem at_rest(rotor(cause, 0.0), "exponential", 5'000'000);
  const auto routh = instabilitySpeed(at_rest.dynamics(), Eigen::Vector2d::Zero(), 0.0);
  ASSERT_TRUE(routh.has_value());
  EXPECT_NEAR(*routh / cause.threshold, 1.0, 1.0e-6);
}

INSTANTIATE_TEST_SUITE_P(
    Causes, Threshold,
    testing::Values(
        Cause{"internal_damping", {{"internal_damping", 12.0}}, kP*(1.0 + kDamping / 12.0)},
        Cause{"fluid",
              {{"fluid_damping", 150.0}, {"fluid_ratio", 0.48}},
              kP*(1.0 + kDamping / 150.0) / 0.48},
        Cause{"internal_damping_and_cross_coupling",
              {{"internal_damping", 12.0}, {"cross_coupling", 3600.0}},
              kP*(1.0 + kDamping / 12.0) - 3600.0 / 12.0}),
    [](const testing::TestParamInfo<Cause>& test) { return std::string(test.param.name); });

}  // namespace threshold_growth_test
}  // namespace whirl_twin

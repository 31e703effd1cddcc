// Causes of self-excited whirl: rotating damping, a fluid that rotates with the shaft,
// cross-coupled stiffness. Thresholds and eigenvalues against the reference rotors, and growth in
// time on both sides of them.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <complex>
#include <fstream>
#include <nlohmann/json.hpp>

#include "../integration/running_system.h"
#include "analysis/equilibria.h"
#include "analysis/instability_speed.h"
#include "messages/input_error.h"
#include "models_under_test.h"

namespace whirl_twin {
namespace whirl_causes_test {

using Json = nlohmann::json;

constexpr double kMass = 2.0;
constexpr double kStiffness = 180000.0;  // p = 300 rad/s

Json referenceRotor(const std::string& id) {
  std::ifstream file(WHIRL_TWIN_REFERENCE "/rotor_cases.json");
  for (const Json& reference : Json::parse(file)) {
    if (reference["id"] == id) {
      return reference;
    }
  }
  throw InputError("no reference rotor " + id);
}

Json expected(const Json& reference, const std::string& name) {
  for (const Json& entry : reference["expected"]) {
    if (entry["name"] == name) {
      return entry["value"];
    }
  }
  throw std::logic_error("nothing expected of " + name);
}

ParameterValues rotor(ParameterValues effects) {
  effects["mass"] = kMass;
  effects["stiffness"] = kStiffness;
  return effects;
}

/// The eigenvalue with the largest real part, its frequency positive.
std::complex<double> leastStable(const ParameterValues& values, double speed) {
  const auto dynamics = dynamicsOf("jeffcott_rotor", values);
  const auto roots = eigenvalues(linearizationAtRest(*dynamics, Eigen::VectorXd::Zero(2), speed));
  const auto root = *std::max_element(
      roots.begin(), roots.end(), [](const auto& a, const auto& b) { return a.real() < b.real(); });
  return {root.real(), std::fabs(root.imag())};
}

double threshold(const ParameterValues& values) {
  return instabilitySpeed(*dynamicsOf("jeffcott_rotor", values), Eigen::VectorXd::Zero(2), 0.0)
      .value_or(std::nan(""));
}

/// Growth rate [1/s] of a whirl at 300 rad/s, from its amplitude over a second.
double growth(const ParameterValues& values, double speed) {
  RunningSystem::Setup s;
  s.model = "jeffcott_rotor";
  s.parameters = values;
  s.speed = speed;
  s.q = {1e-3, 0.0};
  s.v = {0.0, 0.3};  // forward
  RunningSystem system(s, "exponential", 1000000);
  const auto amplitude = [&] {
    return std::sqrt(system.q(0) * system.q(0) + system.q(1) * system.q(1) +
                     (system.v(0) * system.v(0) + system.v(1) * system.v(1)) / 9e4);
  };
  EXPECT_EQ(system.run(1000), StepStatus::kOk);
  const double before = amplitude();
  EXPECT_EQ(system.run(1000), StepStatus::kOk);
  return std::log(amplitude() / before);
}

TEST(WhirlCauses, InternalDampingIsTheReferenceRotor) {
  const Json reference = referenceRotor("B01_internal_damping");
  const ParameterValues values = rotor({{"damping", 24.0}, {"internal_damping", 12.0}});
  EXPECT_NEAR(threshold(values), expected(reference, "threshold_speed"), 1e-8 * 900.0);
  for (const Json& row : expected(reference, "eigenvalues")) {
    const auto root = leastStable(values, row["Om"]);
    EXPECT_NEAR(root.real(), row["forward"][0], 1e-9 * 300.0);
    EXPECT_NEAR(root.imag(), row["forward"][1], 1e-9 * 300.0);
  }
}

// Threshold p / lambda, whirl there at p: about half the shaft's speed.
TEST(WhirlCauses, AFluidThatTurnsWithTheShaftWhirlsTheRotorAboveTwiceItsCriticalSpeed) {
  const Json reference = referenceRotor("E03_fluid_whirl_bently_muszynska");
  const ParameterValues values = rotor({{"fluid_damping", 150.0}, {"fluid_ratio", 0.48}});
  const double limit = threshold(values);
  EXPECT_NEAR(limit, expected(reference, "threshold_speed"), 1e-9 * 625.0);
  EXPECT_NEAR(leastStable(values, limit).imag(), expected(reference, "whirl_freq"), 1e-9 * 300.0);
  // External damping moves it up: p (1 + c / c_f) / lambda.
  const ParameterValues damped =
      rotor({{"fluid_damping", 150.0}, {"fluid_ratio", 0.48}, {"damping", 30.0}});
  EXPECT_NEAR(threshold(damped), 300.0 * (1.0 + 30.0 / 150.0) / 0.48, 1e-9 * 750.0);
}

// q_threshold = c p, whatever the speed.
TEST(WhirlCauses, CrossCoupledStiffnessWhirlsTheRotorAtAnySpeed) {
  const Json reference = referenceRotor("E01_cross_coupled_threshold");
  const double limit = expected(reference, "q_threshold");
  for (const Json& row : expected(reference, "eigs_vs_q")) {
    const auto root = leastStable(rotor({{"damping", 60.0}, {"cross_coupling", row["q"]}}), 0.0);
    EXPECT_NEAR(root.real(), row["least_stable"][0], 1e-8 * 300.0);
    EXPECT_NEAR(root.imag(), row["least_stable"][1], 1e-8 * 300.0);
  }
  for (const double share : {0.999999, 1.000001}) {
    const auto dynamics =
        dynamicsOf("jeffcott_rotor", rotor({{"damping", 60.0}, {"cross_coupling", share * limit}}));
    const Stability s = stability(linearizationAtRest(*dynamics, Eigen::VectorXd::Zero(2), 100.0));
    EXPECT_EQ(s.routh.verdict, share < 1.0 ? Verdict::kAsymptoticallyStable : Verdict::kUnstable);
  }
}

TEST(WhirlCauses, GrowthSeenInTimeIsTheEigenvalues) {
  const ParameterValues fluid = rotor({{"fluid_damping", 150.0}, {"fluid_ratio", 0.48}});
  const ParameterValues seal = rotor({{"damping", 60.0}, {"cross_coupling", 19800.0}});
  for (const double speed : {600.0, 650.0}) {
    EXPECT_NEAR(growth(fluid, speed), leastStable(fluid, speed).real(), 1e-2) << speed;
  }
  EXPECT_NEAR(growth(seal, 100.0), leastStable(seal, 100.0).real(), 1e-2);
}

}  // namespace whirl_causes_test
}  // namespace whirl_twin

// The explicit methods are stable on an undamped whirl up to h p = 2 (semi-implicit Euler, Verlet),
// 2 sqrt(2) (Runge-Kutta 4) and 5.96 (Dormand-Prince 8); the implicit ones and the exact one at any
// step. Multistep methods have lower limits, and the lower the more a motion is damped.
#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <ostream>

#include "running_system.h"

namespace whirl_twin {
namespace stability_limit_test {

constexpr std::int64_t kStep = 1000000;  // [ns]

/// Largest of x, x'/p and y, y'/p after 3000 steps at h p, from 1: infinity once not finite.
double amplitudeAfter(const char* method, double frequency_times_step, double damping = 0.0) {
  const double p = frequency_times_step / (static_cast<double>(kStep) * 1e-9);
  RunningSystem::Setup s;
  s.model = "jeffcott_rotor";
  s.parameters = {{"mass", 1.0}, {"stiffness", p * p}, {"damping", 2.0 * damping * p}};
  s.q = {1.0, 0.0};
  s.v = {0.0, p};
  RunningSystem rotor(s, method, kStep);
  if (rotor.run(3000) != StepStatus::kOk) {
    return std::numeric_limits<double>::infinity();
  }
  return std::max(std::hypot(rotor.q(0), rotor.v(0) / p), std::hypot(rotor.q(1), rotor.v(1) / p));
}

struct Limit {
  const char* method;
  double expected;
};

void PrintTo(const Limit& limit, std::ostream* out) {
  *out << limit.method;
}

class StabilityLimit : public testing::TestWithParam<Limit> {};

TEST_P(StabilityLimit, IsWhereTheWhirlBeginsToGrow) {
  double stable = 1.0;
  double unstable = 8.0;
  for (int i = 0; i < 20; ++i) {
    const double middle = 0.5 * (stable + unstable);
    // Near the limit a symplectic orbit is a long ellipse, yet bounded; growth is exponential.
    (amplitudeAfter(GetParam().method, middle) > 1e4 ? unstable : stable) = middle;
  }
  EXPECT_NEAR(stable, GetParam().expected, 0.02 * GetParam().expected);
}

INSTANTIATE_TEST_SUITE_P(Explicit, StabilityLimit,
                         testing::Values(Limit{"semi_implicit_euler", 2.0},
                                         Limit{"velocity_verlet", 2.0},
                                         Limit{"runge_kutta_4", 2.0 * M_SQRT2},
                                         Limit{"dormand_prince_8", 5.96}),
                         [](const auto& test) { return test.param.method; });

struct DampedLimit {
  const char* name;
  const char* method;
  double damping;  ///< of the critical
  double expected;
};

void PrintTo(const DampedLimit& limit, std::ostream* out) {
  *out << limit.name;
}

class StabilityLimitOfRates : public testing::TestWithParam<DampedLimit> {};

// Where the largest root of the recurrence leaves the unit circle, by enough to show in 3000 steps.
TEST_P(StabilityLimitOfRates, IsWhereADampedWhirlBeginsToGrow) {
  const DampedLimit& limit = GetParam();
  double stable = 0.5 * limit.expected;
  double unstable = 1.5 * limit.expected;
  EXPECT_LT(amplitudeAfter(limit.method, stable, limit.damping), 2.0);
  for (int i = 0; i < 12; ++i) {
    const double middle = 0.5 * (stable + unstable);
    (amplitudeAfter(limit.method, middle, limit.damping) > 1e4 ? unstable : stable) = middle;
  }
  EXPECT_NEAR(stable, limit.expected, 0.03 * limit.expected);
}

INSTANTIATE_TEST_SUITE_P(
    WithAPast, StabilityLimitOfRates,
    testing::Values(DampedLimit{"OfOrder6Undamped", "stoermer_6", 0.0, 0.713},
                    DampedLimit{"OfOrder6Damped", "stoermer_6", 0.05, 0.405},
                    DampedLimit{"OfOrder6DampedMore", "stoermer_6", 0.2, 0.129},
                    DampedLimit{"CorrectedUndamped", "stoermer", 0.0, 1.08},
                    DampedLimit{"CorrectedDamped", "stoermer", 0.05, 0.78},
                    DampedLimit{"CorrectedDampedMore", "stoermer", 0.2, 0.366}),
    [](const auto& test) { return test.param.name; });

class Unlimited : public testing::TestWithParam<const char*> {};

TEST_P(Unlimited, KeepsTheAmplitudeAtAnyStep) {
  for (const double frequency_times_step : {0.1, 1.0, 2.9, 10.0, 50.0, 1000.0}) {
    // 3000 steps, each turning the whirl with a relative rounding of h p.
    EXPECT_NEAR(amplitudeAfter(GetParam(), frequency_times_step), 1.0,
                1e-12 * (1.0 + frequency_times_step))
        << frequency_times_step;
  }
}

INSTANTIATE_TEST_SUITE_P(Implicit, Unlimited,
                         testing::Values("implicit_midpoint", "gauss_legendre_4",
                                         "gauss_legendre_6", "exponential"),
                         [](const auto& test) { return test.param; });

}  // namespace stability_limit_test
}  // namespace whirl_twin

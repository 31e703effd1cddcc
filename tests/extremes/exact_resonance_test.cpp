// An undamped rotor turning exactly at its critical speed. From a start at
//
//   z = 0, z' = -i e p / 2:   z = -i (e p t / 2) e^(ipt)
//
// is the whole motion: the whirl grows in proportion to time, a quarter turn behind the unbalance,
// for the whole run. In full length (measured.h) that is a month.
#include <gtest/gtest.h>

#include <cmath>
#include <complex>

#include "../integration/running_system.h"
#include "measured.h"

namespace whirl_twin {
namespace exact_resonance_test {

using Complex = std::complex<long double>;

constexpr double kP = 16.0;  // [rad/s]; k/m = 256 and the speed are exact
constexpr double kEccentricity = 1e-5;

RunningSystem::Setup atResonance() {
  RunningSystem::Setup s;
  s.model = "jeffcott_rotor";
  s.parameters = {{"mass", 1.0}, {"stiffness", kP * kP}, {"eccentricity", kEccentricity}};
  s.speed = kP;
  s.v = {0.0, -0.5 * kEccentricity * kP};
  return s;
}

/// |z - exact| / |exact| at the present time.
double relativeError(const RunningSystem& rotor, std::int64_t steps, std::int64_t step) {
  const long double t = static_cast<long double>(steps * step) / 1e9L;
  const long double radius = 0.5L * static_cast<long double>(kEccentricity) * kP * t;
  const Complex exact = Complex(0.0L, -radius) * std::polar(1.0L, static_cast<long double>(kP) * t);
  return static_cast<double>(std::abs(Complex(rotor.q(0), rotor.q(1)) - exact) / radius);
}

// The phase of the free whirl has the relative rounding of its step, 1.3e-16 of p t at most
// (long_runs_test).
TEST(AtTheExactCriticalSpeed, TheWhirlGrowsInProportionToTime) {
  for (const std::int64_t step : {kMillisecond, 100 * kMillisecond, 10 * kSecond}) {
    RunningSystem rotor(atResonance(), "exponential", step);
    const std::int64_t seconds = runOf(1000, 1000000);
    double error = 0.0;
    for (int i = 1; i <= 10; ++i) {
      const std::int64_t steps = seconds * kSecond / step / 10;
      ASSERT_EQ(rotor.run(steps), StepStatus::kOk);
      error = std::fmax(error, relativeError(rotor, steps * i, step));
    }
    const double turned = kP * static_cast<double>(seconds);
    expectWithin(1.3e-16 * turned + 1e-12, error,
                 fmt::format("error of r = e p t / 2 after {} s in steps of {} ms", seconds,
                             step / kMillisecond));
    EXPECT_NEAR(std::hypot(rotor.q(0), rotor.q(1)),
                0.5 * kEccentricity * kP * static_cast<double>(seconds),
                2e-9 * kEccentricity * kP * static_cast<double>(seconds));
  }
}

class EveryMethodAtResonance : public testing::TestWithParam<std::string> {};

// A method's numerical frequency detunes it: after p t radians the whirl deviates from the exact
// one by half of the detuning times p t, and in the end it shows beats.
TEST_P(EveryMethodAtResonance, GrowsAsItsOwnFrequencyAllows) {
  constexpr std::int64_t kSteps = 10000;
  constexpr double kStepAngle = kP * 1e-3;  // p h
  RunningSystem rotor(atResonance(), GetParam(), kMillisecond);
  ASSERT_EQ(rotor.run(kSteps), StepStatus::kOk);
  const double bound = 0.55 * detuning(GetParam(), kStepAngle) * kStepAngle * kSteps + 2e-13;
  expectWithin(bound, relativeError(rotor, kSteps, kMillisecond),
               "error of r = e p t / 2 at p t = 160 by " + GetParam());
}

INSTANTIATE_TEST_SUITE_P(AtTheExactCriticalSpeed, EveryMethodAtResonance,
                         testing::ValuesIn(integratorsOf("jeffcott_rotor")),
                         [](const auto& test) { return test.param; });

TEST(AtTheExactCriticalSpeed, DampingWouldHoldTheGrowthAtAnAmplificationOfOneOverTwoZeta) {
  RunningSystem::Setup s = atResonance();
  const double zeta = 1e-3;
  s.parameters["damping"] = 2.0 * zeta * kP;
  RunningSystem rotor(s, "exponential", kMillisecond);
  ASSERT_EQ(rotor.run(2000000), StepStatus::kOk);  // zeta p t = 32
  EXPECT_NEAR(std::hypot(rotor.q(0), rotor.q(1)) / (kEccentricity / (2.0 * zeta)), 1.0, 1e-10);
}

}  // namespace exact_resonance_test
}  // namespace whirl_twin

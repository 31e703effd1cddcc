// An undamped rotor for a month at 1 kHz: the exact step a billion times with
// WHIRL_TWIN_EXTREMES=full in the environment, one or two million times without; the other methods
// a hundred million times and two hundred thousand times.
#include <gtest/gtest.h>

#include <cmath>
#include <complex>

#include "../integration/running_system.h"
#include "../integration/whirl_closed_form.h"
#include "measured.h"

namespace whirl_twin {
namespace long_runs_test {

using Complex = std::complex<long double>;

constexpr double kP = 16.0;   // [rad/s], sqrt(k/m)
constexpr double kZ = 0.016;  // p h
constexpr double kRadius = 1e-3;
constexpr int kLooks = 20;

/// A free circular whirl, z = R e^(ipt).
RunningSystem::Setup freeWhirl() {
  RunningSystem::Setup s;
  s.model = "jeffcott_rotor";
  s.parameters = {{"mass", 1.0}, {"stiffness", kP * kP}};
  s.q = {kRadius, 0.0};
  s.v = {0.0, kRadius * kP};
  return s;
}

/// Relative; 1 at the start.
double energy(const RunningSystem& rotor) {
  const Energies e = rotor.energies();
  return (e.kinetic + e.potential) / (kRadius * kRadius * kP * kP);
}

// The step's matrix represents the angle p h of a free whirl to half a unit of a double, and the
// step 0.001 s itself is rounded by 2e-17 of it: the same error in every step, so the phase error
// grows to 1.1e-16 + 2e-17 of p t. For a month (1e9 steps) below 1e-9 rad that allows p t = 7.6e6,
// p = 7.6 rad/s. The same holds for a radius and an energy.
TEST(AMonthOfSteps, KeepsEnergyAndPhaseOfAFreeWhirl) {
  const std::int64_t steps = runOf(1000000, 1000000000);
  for (const double p : {7.6, 16.0, 100.0}) {
    RunningSystem::Setup s = freeWhirl();
    const double stiffness = p * p;
    s.parameters["stiffness"] = stiffness;
    const long double frequency = std::sqrt(static_cast<long double>(stiffness));
    s.v = {0.0, kRadius * p};
    RunningSystem rotor(s, "exponential", kMillisecond);
    const double start = rotor.energies().jacobi;
    double phase = 0.0;
    double drift = 0.0;
    for (std::int64_t i = 1; i <= kLooks; ++i) {
      ASSERT_EQ(rotor.run(steps / kLooks), StepStatus::kOk);
      const long double t = static_cast<long double>(steps / kLooks * i) / 1000.0L;
      const Complex turned = Complex(rotor.q(0), rotor.q(1)) / std::polar(1.0L, frequency * t);
      phase = std::fmax(phase, static_cast<double>(std::abs(std::arg(turned))));
      drift = std::fmax(drift, std::fabs(rotor.energies().jacobi / start - 1.0));
    }
    const double turned = p * 1e-3 * static_cast<double>(steps);
    const std::string what = fmt::format(" of a free whirl turned by {:.1e} rad", turned);
    expectWithin(1.3e-16 * turned + 1e-15, phase, "phase error [rad]" + what);
    expectWithin(2.2e-16 * turned + 1e-14, drift, "energy drift" + what);
  }
}

// As an instrument would show a rotor in service: the lag of its steady whirl behind the unbalance.
// The free whirl has decayed and its errors with it; the shaft's angle keeps its accuracy.
TEST(AMonthOfSteps, LosesNothingOfTheLagOfASteadyWhirl) {
  const double speed = 18.5;
  const double zeta = 0.05;
  RunningSystem::Setup s = freeWhirl();
  s.parameters["eccentricity"] = 1e-4;
  s.parameters["damping"] = 2.0 * zeta * kP;
  s.speed = speed;
  RunningSystem rotor(s, "exponential", kMillisecond);
  const std::int64_t steps = runOf(1000000, 1000000000);
  ASSERT_EQ(rotor.run(steps), StepStatus::kOk);
  const Complex response =
      1e-4L * static_cast<long double>(speed) * speed /
      Complex(static_cast<long double>(kP) * kP - static_cast<long double>(speed) * speed,
              2.0L * zeta * kP * static_cast<long double>(speed));
  const long double angle =
      static_cast<long double>(speed) * (static_cast<long double>(steps) / 1000.0L);
  const Complex found = Complex(rotor.q(0), rotor.q(1)) / std::polar(1.0L, angle) / response;
  const std::string after =
      fmt::format(" of a steady whirl after {:.0e} steps", static_cast<double>(steps));
  expectWithin(1e-13, static_cast<double>(std::abs(std::arg(found))), "lag [rad]" + after);
  expectWithin(1e-13, static_cast<double>(std::abs(std::abs(found) - 1.0L)), "radius" + after);
}

// With unbalance, near its critical speed: synchronous and free whirl beat for a month. The
// complete motion in extended precision is the reference.
TEST(AMonthOfSteps, StaysOnTheClosedFormOfAnUnbalancedRotor) {
  const double speed = 18.5;
  const double eccentricity = 1e-4;
  RunningSystem::Setup s = freeWhirl();
  s.parameters["eccentricity"] = eccentricity;
  s.speed = speed;
  RunningSystem rotor(s, "exponential", kMillisecond);
  const ClosedFormWhirl exact(0.0L, static_cast<long double>(kP) * kP,
                              static_cast<long double>(eccentricity) * speed * speed, speed,
                              Complex(s.q[0], s.q[1]), Complex(s.v[0], s.v[1]));
  const std::int64_t steps = runOf(2000000, 1000000000);
  double error = 0.0;
  double residual = 0.0;
  const double start = rotor.energies().jacobi;
  for (std::int64_t i = 1; i <= kLooks; ++i) {
    ASSERT_EQ(rotor.run(steps / kLooks), StepStatus::kOk);
    const Complex z = exact(static_cast<long double>(steps / kLooks * i) / 1000.0L);
    error = std::fmax(error,
                      static_cast<double>(std::abs(Complex(rotor.q(0), rotor.q(1)) - z)) / kRadius);
    const Energies e = rotor.energies();
    residual =
        std::fmax(residual, std::fabs(e.jacobi - start - rotor.work()) / (e.kinetic + e.potential));
  }
  const std::string after = fmt::format(" after {:.0e} steps", static_cast<double>(steps));
  // Errors as above, p t = 1.6e7 rad in full, modulated by the beats.
  expectWithin(fullLength() ? 3e-9 : 1e-11, error, "error of an unbalanced whirl / r" + after);
  expectWithin(fullLength() ? 1e-9 : 1e-11, residual, "energy residual of it" + after);
}

class EveryMethodInALongRun : public testing::TestWithParam<std::string> {};

// Amplification of a whirl e^(ipt) by a method's stability function R: |R(i z)|^2 = 1 - z^6/72 +
// z^8/576 for Runge-Kutta 4; 1 for the implicit methods and the exact one. Semi-implicit Euler
// conserves T + V - h k r.v / 2 and Verlet T + V - z^2 V / 4: on an orbit that is a circle up to
// terms in z and z^2, T + V oscillates by z^2 and z^4 and no more. Stoermer 6 gains 7/48 z^8 a
// step: the terms that its sum omits, 863/12096 of the sixth difference and 275/4032 of the
// seventh, lag by half a step each. Methods not named here are of order 7 or more, or conserve it:
// 1 - O(z^8) at worst, z^8 = 4e-15 with a factor of 1e-4 or less.
TEST_P(EveryMethodInALongRun, GainsAndLosesTheEnergyItsStabilityFunctionSays) {
  RunningSystem rotor(freeWhirl(), GetParam(), kMillisecond);
  const std::int64_t steps = runOf(200000, 100000000);
  const double rounding = fullLength() ? 1e-9 : 1e-12;
  double error = 0.0;
  for (std::int64_t i = 1; i <= kLooks; ++i) {
    ASSERT_EQ(rotor.run(steps / kLooks), StepStatus::kOk);
    const double count = static_cast<double>(steps / kLooks * i);
    const double expected =
        GetParam() == "runge_kutta_4"
            ? std::exp(count * std::log1p(-std::pow(kZ, 6) / 72.0 + std::pow(kZ, 8) / 576.0))
        : GetParam() == "stoermer_6" ? std::exp(count * 7.0 / 48.0 * std::pow(kZ, 8))
                                     : 1.0;
    error = std::fmax(error, std::fabs(energy(rotor) - expected));
  }
  const double bound = GetParam() == "semi_implicit_euler" ? kZ * kZ
                       : GetParam() == "velocity_verlet"   ? kZ * kZ * kZ * kZ
                                                           : rounding;
  expectWithin(bound, error,
               fmt::format("energy of a free whirl by {} after {:.0e} steps, off by", GetParam(),
                           static_cast<double>(steps)));
}

INSTANTIATE_TEST_SUITE_P(AMonthOfSteps, EveryMethodInALongRun,
                         testing::ValuesIn(integratorsOf("jeffcott_rotor")),
                         [](const auto& test) { return test.param; });

}  // namespace long_runs_test
}  // namespace whirl_twin

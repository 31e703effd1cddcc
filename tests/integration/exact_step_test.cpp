// At constant speed the exponential step has no truncation error: it is on the closed form for any
// step, after any time, at resonance, without damping and with more than critical.
#include <gtest/gtest.h>

#include <cmath>
#include <complex>
#include <ostream>

#include "running_system.h"
#include "whirl_closed_form.h"

namespace whirl_twin {
namespace exact_step_test {

using Complex = ClosedFormWhirl::Complex;

struct Case {
  const char* name;
  double p;           // [rad/s], sqrt(k/m)
  double zeta;        // external damping
  double ratio;       // speed over p
  std::int64_t step;  // [ns]
  double seconds;
  double zeta_internal = 0.0;
  double stiffness_ratio = 1.0;  // k_y/k_x
};

void PrintTo(const Case& c, std::ostream* out) {
  *out << c.name;
}

constexpr double kMass = 2.0;
constexpr double kEccentricity = 1e-3;
constexpr double kX = 4e-4, kY = -7e-4, kRateX = 0.3, kRateY = 0.1;  // start, rates over p

RunningSystem::Setup setupOf(const Case& c) {
  RunningSystem::Setup s;
  s.model = "jeffcott_rotor";
  s.speed = c.ratio * c.p;
  s.parameters = {{"mass", kMass},
                  {"stiffness", kMass * c.p * c.p},
                  {"stiffness_y", c.stiffness_ratio * kMass * c.p * c.p},
                  {"damping", 2.0 * c.zeta * c.p * kMass},
                  {"internal_damping", 2.0 * c.zeta_internal * c.p * kMass},
                  {"eccentricity", kEccentricity}};
  s.q = {kX, kY};
  s.v = {kRateX * kEccentricity * c.p, kRateY * kEccentricity * c.p};
  return s;
}

class ExactStep : public testing::TestWithParam<Case> {};

TEST_P(ExactStep, StaysOnTheClosedForm) {
  const Case& c = GetParam();
  const RunningSystem::Setup s = setupOf(c);
  RunningSystem rotor(s, "exponential", c.step);

  const long double m = kMass;
  const long double w = s.speed;
  const long double internal = s.parameters.at("internal_damping");
  const long double damping = (s.parameters.at("damping") + internal) / m;
  const long double force = static_cast<long double>(kEccentricity) * w * w;
  const Complex i(0.0L, 1.0L);
  const bool isotropic = c.stiffness_ratio == 1.0;
  const Complex z0(s.q[0], s.q[1]);
  const Complex v0(s.v[0], s.v[1]);
  const long double stiffness = s.parameters.at("stiffness");
  const ClosedFormWhirl whirl(damping, (stiffness - i * internal * w) / m, force, w, z0, v0);
  const ClosedFormWhirl x(damping, stiffness / m, force, w, z0.real(), v0.real());
  const ClosedFormWhirl y(damping, s.parameters.at("stiffness_y") / m, -i * force, w, z0.imag(),
                          v0.imag());
  // Of the largest radius so far: turned by up to 1e5 rad at a frequency rounded to 1e-16.
  const double tolerance = 1e-11;
  const auto total = std::llround(c.seconds * 1e9) / c.step;
  double largest = kEccentricity;
  for (int part = 0; part < 10; ++part) {
    ASSERT_EQ(rotor.run(total / 10), StepStatus::kOk);
    const auto t = static_cast<long double>(total / 10 * (part + 1) * c.step) * 1e-9L;
    const Complex z = isotropic ? whirl(t) : Complex(x(t).real(), y(t).real());
    const double radius = static_cast<double>(std::abs(z));
    largest = std::max(largest, radius);
    const Complex found(rotor.q(0), rotor.q(1));
    EXPECT_LT(static_cast<double>(std::abs(found - z)), tolerance * largest)
        << "at " << rotor.time() << " s, radius " << radius;
  }
}

constexpr std::int64_t kMicrosecond = 1000;
constexpr std::int64_t kMillisecond = 1000 * kMicrosecond;
constexpr std::int64_t kSecond = 1000 * kMillisecond;

INSTANTIATE_TEST_SUITE_P(
    Rotors, ExactStep,
    testing::Values(
        Case{"TenMicroseconds", 50.0, 0.05, 0.8, 10 * kMicrosecond, 100.0},
        Case{"TenMicrosecondsUndamped", 10.0, 0.0, 0.8, 10 * kMicrosecond, 100.0},
        Case{"Millisecond", 50.0, 0.05, 0.8, kMillisecond, 100.0},
        Case{"TenMilliseconds", 1000.0, 0.01, 1.5, 10 * kMillisecond, 100.0},
        Case{"Second", 1000.0, 0.05, 0.8, kSecond, 100.0},
        Case{"SecondSlow", 1.0, 0.001, 1.001, kSecond, 5000.0},
        Case{"SecondUndamped", 1000.0, 0.0, 0.8, kSecond, 100.0},
        Case{"Undamped", 1.0, 0.0, 0.3, kMillisecond, 100.0},
        Case{"FastUndamped", 1000.0, 0.0, 1.3, kMillisecond, 100.0},
        Case{"ResonanceUndamped", 16.0, 0.0, 1.0, kMillisecond, 100.0},
        Case{"ResonanceUndampedLargeSteps", 16.0, 0.0, 1.0, kSecond, 100.0},
        Case{"ResonanceDamped", 16.0, 0.001, 1.0, kMillisecond, 100.0},
        Case{"Critical", 16.0, 1.0, 0.9, kMillisecond, 100.0},
        Case{"Overdamped", 100.0, 20.0, 3.0, kMillisecond, 100.0},
        Case{"OverdampedLargeSteps", 100.0, 20.0, 3.0, kSecond, 100.0},
        Case{"AtRest", 30.0, 0.02, 0.0, kMillisecond, 100.0},
        Case{"Backwards", 30.0, 0.02, -1.2, kMillisecond, 100.0},
        Case{"Anisotropic", 30.0, 0.02, 1.1, kMillisecond, 100.0, 0.0, 1.7},
        Case{"AnisotropicLargeSteps", 30.0, 0.0, 1.1, kSecond, 100.0, 0.0, 1.7},
        Case{"InternalDampingBelowThreshold", 30.0, 0.02, 2.0, kMillisecond, 100.0, 0.01},
        Case{"InternalDampingAboveThreshold", 30.0, 0.02, 4.0, kMillisecond, 20.0, 0.01}),
    [](const auto& test) { return test.param.name; });

TEST(ExactStepAtResonance, GrowsByHalfTheEccentricityARadian) {
  // From rest, undamped, w = p: |z| -> e p t / 2.
  RunningSystem::Setup s;
  s.model = "jeffcott_rotor";
  s.parameters = {{"mass", 1.0}, {"stiffness", 256.0}, {"eccentricity", kEccentricity}};
  s.speed = 16.0;
  RunningSystem rotor(s, "exponential", kMillisecond);
  for (int i = 0; i < 10; ++i) {
    rotor.run(10000);
    const double growth = 0.5 * kEccentricity * s.speed * rotor.time();
    EXPECT_NEAR(std::hypot(rotor.q(0), rotor.q(1)), growth, kEccentricity);
  }
}

TEST(ExactStep, DoesNotDependOnTheStep) {
  const Case c{"", 50.0, 0.03, 1.2, 0, 0.0};
  RunningSystem one(setupOf(c), "exponential", kSecond);
  RunningSystem many(setupOf(c), "exponential", 20 * kMicrosecond);
  one.run(1);
  many.run(50000);
  for (std::size_t i = 0; i < 2; ++i) {
    EXPECT_NEAR(one.q(i), many.q(i), 1e-14 * kEccentricity * c.p);
    EXPECT_NEAR(one.v(i), many.v(i), 1e-14 * kEccentricity * c.p * c.p);
  }
  EXPECT_NEAR(one.work(), many.work(), 1e-12 * many.energies().kinetic);
}

// An alternating load without a shaft is not frozen: m_e th'' + c_e th' + k_e th = q cos(W t) with
// the closed form of the steady motion, and the free motion that starts it from rest.
TEST(ExactStep, FollowsALoadThatAlternatesWithoutAShaft) {
  const double mass = 12.0, l = 2.0, k = 4000.0, c = 6.0, f = 100.0, w = 15.0;
  RunningSystem::Setup s;
  s.model = "hinged_beam";
  s.settings.choices["geometry"] = "small";
  s.parameters = {{"mass", mass}, {"length", l},         {"stiffness", k},
                  {"damping", c}, {"load_amplitude", f}, {"load_frequency", w}};
  RunningSystem beam(s, "exponential", 1000000);
  ASSERT_EQ(beam.run(1700), StepStatus::kOk);
  const double m = mass / 3.0;  // the equation of the notes, divided by l^2
  const std::complex<double> steady = 0.5 * f / std::complex<double>(0.25 * k - m * w * w, c * w);
  const double decay = c / (2.0 * m);
  const double p = std::sqrt(0.25 * k / m - decay * decay);
  const double q0 = -steady.real();
  const double v0 = w * steady.imag();
  const double t = beam.time();
  const double exact =
      (steady * std::polar(1.0, w * t)).real() +
      std::exp(-decay * t) * (q0 * std::cos(p * t) + (v0 + decay * q0) / p * std::sin(p * t));
  EXPECT_NEAR(beam.q(0), exact, 1e-12);
}

}  // namespace exact_step_test
}  // namespace whirl_twin

// The systems of the lecture notes with extreme parameters: at a bifurcation, stiff, asymmetric,
// overdamped, balanced on a saddle, and swinging for eleven days.
#include <gtest/gtest.h>

#include <cmath>

#include "../analysis/models_under_test.h"
#include "../integration/running_system.h"
#include "analysis/equilibria.h"

namespace whirl_twin {
namespace catalogue_extremes_test {

constexpr std::int64_t kMillisecond = 1000000;
constexpr double kPi = 3.14159265358979323846;

/// When coordinate 0 first passes zero [s], between two steps by its rate.
double firstZero(RunningSystem& system, int most_steps) {
  for (int i = 0; i < most_steps; ++i) {
    EXPECT_EQ(system.run(1), StepStatus::kOk);
    if (system.q(0) <= 0.0) {
      return system.time() - system.q(0) / system.v(0);
    }
  }
  return std::nan("");
}

// w^2 = g/l: the linear stiffness vanishes, th'' = -(g/l) th^3 / 2 near the vertical. A quarter
// swing takes (2 / (A w)) K, K = integral of du / sqrt(1 - u^4) = 1.3110287771461: the smaller the
// slower.
TEST(Extremes, AtTheBirthOfTheConeThePeriodGoesAsOneOverTheAmplitude) {
  for (const double amplitude : {0.1, 0.01, 0.001}) {
    RunningSystem::Setup s;
    s.model = "spinning_pendulum";
    s.parameters = {{"mass", 0.7}, {"length", 1.0}};
    s.gravity = 9.0;
    s.speed = 3.0;  // 3^2 = 9 / 1
    s.q = {amplitude};
    RunningSystem pendulum(s, "gauss_legendre_6", 5 * kMillisecond);
    const double quarter = 2.0 * 1.3110287771461 / (amplitude * 3.0);
    // The next term of the force is th^2 of this one.
    EXPECT_NEAR(firstZero(pendulum, 1000000) / quarter, 1.0, amplitude * amplitude + 1e-6);
  }
  const auto at_birth = dynamicsOf("spinning_pendulum", {{"mass", 0.7}, {"length", 1.0}}, 9.0);
  const Stability s = stability(linearizationAtRest(*at_birth, Eigen::VectorXd::Zero(1), 3.0));
  EXPECT_EQ(s.routh.imaginary, 2) << "a double root at zero, exactly";
  EXPECT_EQ(s.routh.right, 0);
}

// a -> mu h: p^2 = mu g / (a - mu h) -> infinity. The form that slides is exact at any p.
TEST(Extremes, APlankAboutToTipOscillatesEverFasterAndBeyondFallsAway) {
  for (const double left : {1e-2, 1e-6, 1e-12}) {
    RunningSystem::Setup s;
    s.model = "friction_oscillator";
    s.parameters = {{"mass", 1.0},
                    {"friction_coefficient", 0.5},
                    {"half_spacing", 0.25 + left},
                    {"height", 0.5},
                    {"roller_speed", 1.0}};
    s.settings.choices["friction"] = "sliding";
    s.q = {1e-3};
    const double p = std::sqrt(0.5 * 9.81 / (0.25 + left - 0.25));  // as rounded in the model
    RunningSystem plank(s, "exponential", kMillisecond);
    ASSERT_EQ(plank.run(1000), StepStatus::kOk);
    EXPECT_NEAR(plank.q(0), 1e-3 * std::cos(p * plank.time()), 1e-3 * (1e-11 + 1e-15 * p));
  }
  const auto tipped = dynamicsOf("friction_oscillator", {{"mass", 1.0},
                                                         {"friction_coefficient", 0.5},
                                                         {"half_spacing", 0.2},
                                                         {"height", 0.5},
                                                         {"roller_speed", 1.0}});
  const Eigen::VectorXd zero = Eigen::VectorXd::Zero(1);
  EXPECT_EQ(stability(linearizationAtRest(*tipped, zero, 0.0)).routh.verdict, Verdict::kUnstable);
  bool tips = false;
  for (const Condition& c : tipped->conditions(zero, zero, zero, {})) {
    tips = tips || (c.name == "no_tipping" && !(c.margin > 0.0));
  }
  EXPECT_TRUE(tips);
}

// kappa = k r^2 / (m g l): sin u = -kappa u has further solutions below 0.2172336282 only.
TEST(Extremes, AHeavySidedDiscGainsEquilibriaAsItsSpringSoftens) {
  const auto count = [](double kappa) {
    return equilibria(*dynamicsOf("rolling_disc", {{"disc_mass", 3.0},
                                                   {"disc_inertia", 0.135},
                                                   {"radius", 0.3},
                                                   {"stiffness", kappa * 9.81 * 0.2 / 0.09},
                                                   {"offset_mass", 1.0},
                                                   {"offset", 0.2}}),
                      0.0)
        .size();
  };
  EXPECT_EQ(count(0.2172336282 + 1e-6), 1u);
  EXPECT_EQ(count(0.2172336282 - 1e-6), 5u) << "a pair to each side";
}

// k -> infinity: the slider is fixed on its rod, and the system becomes a rigid pendulum with
// theta'' = -(m0 r + m l / 2) g sin(theta) / (m0 r^2 + m l^2 / 3).
TEST(Extremes, AnEverStifferSpringMakesARigidPendulum) {
  const double m0 = 1.0, m = 0.5, l = 1.2, r = 0.5, g = 9.81;
  RunningSystem::Setup rigid;
  rigid.model = "double_pendulum";  // its lower arm weighs nothing: one compound pendulum
  const double inertia = m0 * r * r + m * l * l / 3.0;
  const double moment = m0 * r + m * l / 2.0;
  const double mass = m0 + m;
  const double center = moment / mass;
  rigid.parameters = {{"mass1", mass},     {"mass2", 1e-12},
                      {"length1", 1.0},    {"length2", 1.0},
                      {"center1", center}, {"inertia1", inertia - mass * center * center}};
  rigid.q = {0.5, 0.5};
  RunningSystem reference(rigid, "gauss_legendre_6", kMillisecond);
  ASSERT_EQ(reference.run(2000), StepStatus::kOk);
  for (const double k : {1e6, 1e8, 1e10, 1e12}) {
    RunningSystem::Setup s;
    s.model = "rod_slider";
    s.parameters = {{"slider_mass", m0},
                    {"rod_mass", m},
                    {"rod_length", l},
                    {"stiffness", k},
                    {"free_length", r}};
    s.q = {r + m0 * g * std::cos(0.5) / k, 0.5};
    RunningSystem slider(s, "gauss_legendre_6", kMillisecond);
    ASSERT_EQ(slider.run(2000), StepStatus::kOk);
    EXPECT_NEAR(slider.q(1), reference.q(0), 200.0 / k + 1e-9) << k;
    EXPECT_NEAR(slider.q(0), r, 100.0 / k) << k;
  }
}

// m1 l1 l2 p^4 - (m1 + m2) g (l1 + l2) p^2 + (m1 + m2) g^2 = 0.
TEST(Extremes, DoublePendulumsWithMassesAThousandAndMoreApart) {
  for (const double ratio : {1e-4, 1e4}) {
    const double g = 9.81;
    const ParameterValues masses{
        {"mass1", 1.0}, {"mass2", ratio}, {"length1", 1.0}, {"length2", 0.8}};
    const auto pendulum = dynamicsOf("double_pendulum", masses, g);
    const auto rest =
        operatingPoint(*pendulum, Eigen::VectorXd::Zero(2), Eigen::VectorXd::Zero(2), 0.0);
    ASSERT_TRUE(rest);
    const double b = (1.0 + ratio) * g * 1.8;
    const double root = std::sqrt(b * b - 4.0 * 0.8 * (1.0 + ratio) * g * g);
    const double high = (b + root) / (2.0 * 0.8);
    const double low = (1.0 + ratio) * g * g / (0.8 * high);
    EXPECT_NEAR(rest->stability.natural_frequencies.at(0), std::sqrt(low), 1e-10 * std::sqrt(low));
    EXPECT_NEAR(rest->stability.natural_frequencies.at(1), std::sqrt(high),
                1e-10 * std::sqrt(high));

    RunningSystem::Setup s;
    s.model = "double_pendulum";
    s.parameters = masses;
    s.q = {0.3, 0.2};
    s.v = {0.0, 0.0};
    // The light joint of a heavy lower bob rings at some thousand rad/s as it passes the straight
    // line: that requires steps of 20 us. (At a millisecond the energy residual shows the error.)
    RunningSystem swing(s, "gauss_legendre_6", ratio > 1.0 ? kMillisecond / 50 : kMillisecond);
    const double start = swing.energies().jacobi;
    ASSERT_EQ(swing.run(ratio > 1.0 ? 500000 : 10000), StepStatus::kOk);
    EXPECT_NEAR(swing.energies().jacobi, start, 1e-10 * start) << ratio;
  }
}

// zeta = 100: the slow root is p / (2 zeta), the fast one 2 zeta p, four decades above it.
TEST(Extremes, AnOverdampedBeamCreepsBackAtItsSlowRoot) {
  const double mass = 12.0, k = 4000.0;
  const double p = std::sqrt(3.0 * k / (4.0 * mass));
  const double c = 100.0 * 2.0 * mass * p / 3.0;
  for (const char* method : {"exponential", "gauss_legendre_6"}) {
    RunningSystem::Setup s;
    s.model = "hinged_beam";
    s.settings.choices["geometry"] = "small";
    s.parameters = {{"mass", mass}, {"length", 2.0},         {"stiffness", k},
                    {"damping", c}, {"load_amplitude", 0.0}, {"load_frequency", 0.0}};
    s.q = {0.1};
    RunningSystem beam(s, method, kMillisecond);
    ASSERT_EQ(beam.run(5000), StepStatus::kOk);
    const double slow = p * (100.0 - std::sqrt(1e4 - 1.0));
    const double fast = p * (100.0 + std::sqrt(1e4 - 1.0));
    const double exact = 0.1 * fast / (fast - slow) * std::exp(-slow * beam.time());
    EXPECT_NEAR(beam.q(0), exact, 1e-9 * exact) << method;
  }
}

// Within 1e-9 of a saddle: the deviation grows as in the linearized motion, for twenty of its
// e-foldings.
TEST(Extremes, NearASaddleADeviationOfANanoradianGrowsAsItShould) {
  RunningSystem::Setup s;
  s.model = "sprung_inverted_pendulum";
  s.parameters = {{"mass", 1.0}, {"length", 1.0}, {"stiffness", 0.0}};
  s.q = {1e-9};
  RunningSystem pendulum(s, "gauss_legendre_6", kMillisecond);
  const double rate = std::sqrt(s.gravity);
  ASSERT_EQ(pendulum.run(4000), StepStatus::kOk);
  const double linear = 1e-9 * std::cosh(rate * 4.0);
  EXPECT_NEAR(pendulum.q(0) / linear, 1.0, linear * linear + 1e-6);

  RunningSystem::Setup both;
  both.model = "double_pendulum";
  both.parameters = {{"mass1", 1.0}, {"mass2", 1.0}, {"length1", 1.0}, {"length2", 1.0}};
  // along the slower of its two unstable directions
  both.q = {kPi + 1e-9, kPi + std::sqrt(2.0) * 1e-9};
  RunningSystem top(both, "gauss_legendre_6", kMillisecond);
  ASSERT_EQ(top.run(2000), StepStatus::kOk);
  const double slow = std::sqrt((2.0 - std::sqrt(2.0)) * both.gravity);
  // 1e-16 of rounding in the start falls the faster way, by e^5.79 a second.
  EXPECT_NEAR((top.q(0) - kPi) / (1e-9 * std::cosh(slow * 2.0)), 1.0, 0.05);
}

// 1e6 s of undamped swing: a bounded energy error, and the phase of an elliptic function.
TEST(Extremes, ElevenDaysOfUndampedSwing) {
  RunningSystem::Setup s;
  s.model = "double_pendulum";
  s.parameters = {{"mass1", 1.0}, {"mass2", 1.0}, {"length1", 5.0}, {"length2", 5.0}};
  s.q = {0.1, 0.1 * std::sqrt(2.0)};
  RunningSystem pendulum(s, "gauss_legendre_6", 50 * kMillisecond);
  const double start = pendulum.energies().jacobi;
  double largest = 0.0;
  for (int i = 0; i < 20; ++i) {
    ASSERT_EQ(pendulum.run(1000000), StepStatus::kOk);
    largest = std::fmax(largest, std::fabs(pendulum.energies().jacobi - start));
  }
  EXPECT_NEAR(pendulum.time(), 1e6, 1e-6);
  // p h = 0.13 for the faster mode; what drifts is the rounding of 2e7 steps.
  EXPECT_LT(largest, 1e-9 * start);
}

}  // namespace catalogue_extremes_test
}  // namespace whirl_twin

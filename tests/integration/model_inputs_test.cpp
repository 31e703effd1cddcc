// Inputs of models: closed forms of a driven oscillator by every exact engine, run-ups against far
// finer steps, what an input means in each kind of model, and tables against commands.
#include <gtest/gtest.h>

#include <cmath>
#include <complex>
#include <random>

#include "control/inputs.h"
#include "running_system.h"

namespace whirl_twin {
namespace model_inputs_test {

constexpr std::int64_t kMillisecond = 1000000;
constexpr double kPi = 3.14159265358979323846;

/// m x'' + c x' + k x = u, u a straight line in time: the state after t.
struct Oscillator {
  long double m, c, k;
  long double x = 0.0L, v = 0.0L;

  void advance(long double t, long double u, long double slope) {
    // A particular solution a + b t, and the free motion from the remaining initial state.
    const long double b = slope / k;
    const long double a = (u - c * b) / k;
    const long double d = c / (2.0L * m);
    const long double w = std::sqrt(k / m - d * d);
    const long double x0 = x - a;
    const long double v0 = v - b;
    const long double decay = std::exp(-d * t);
    const long double co = std::cos(w * t);
    const long double si = std::sin(w * t);
    x = a + b * t + decay * (x0 * co + (v0 + d * x0) / w * si);
    v = b + decay * (v0 * co - (d * v0 + (k / m) * x0) / w * si);
  }
};

/// From rest under F cos(W t + phase), W not the undamped frequency or damped.
double harmonicResponse(double m, double c, double k, double force, double frequency, double phase,
                        double time) {
  const std::complex<long double> i(0.0L, 1.0L);
  const std::complex<long double> amplitude =
      static_cast<long double>(force) * std::exp(i * static_cast<long double>(phase)) /
      (k - static_cast<long double>(m) * frequency * frequency + i * (1.0L * c * frequency));
  const std::complex<long double> now =
      amplitude * std::exp(i * std::fmod(static_cast<long double>(frequency) * time,
                                         2.0L * 3.14159265358979323846264L));
  Oscillator rest{m, c, k, -amplitude.real(), -(i * (1.0L * frequency) * amplitude).real()};
  rest.advance(time, 0.0L, 0.0L);
  return static_cast<double>(now.real() + rest.x);
}

/// An oscillator in the form of each engine: with x' s input called `force`.
struct Engine {
  const char* name;
  const char* model;
  const char* input;
  double mass, damping, stiffness;
  ParameterValues parameters;
  Settings settings;
};

void PrintTo(const Engine& e, std::ostream* out) {
  *out << e.name;
}

Settings oneMass(double mass, double damping, double stiffness) {
  Settings settings;
  const auto matrix = [](double x) { return Eigen::MatrixXd::Constant(1, 1, x); };
  settings.matrices = {
      {"mass", matrix(mass)}, {"damping", matrix(damping)}, {"stiffness", matrix(stiffness)}};
  return settings;
}

Settings sliding() {
  Settings settings;
  settings.choices["friction"] = "sliding";
  return settings;
}

class ExactEngine : public testing::TestWithParam<Engine> {
 protected:
  RunningSystem::Setup setup(const InputSignal& signal) const {
    RunningSystem::Setup s;
    s.model = GetParam().model;
    s.parameters = GetParam().parameters;
    s.settings = GetParam().settings;
    s.gravity = 10.0;
    s.speed = 3.0;
    s.inputs = {{GetParam().input, signal}};
    return s;
  }
  double frequency() const { return std::sqrt(GetParam().stiffness / GetParam().mass); }
};

TEST_P(ExactEngine, FollowsAConstant) {
  const Engine& e = GetParam();
  RunningSystem system(setup(InputSignal::constant(4.3)), "exponential", 37 * kMillisecond);
  Oscillator expected{e.mass, e.damping, e.stiffness};
  for (int i = 0; i < 200; ++i) {
    ASSERT_EQ(system.run(1), StepStatus::kOk);
    expected.advance(0.037L, 4.3L, 0.0L);
    ASSERT_NEAR(system.q(0), static_cast<double>(expected.x), 1e-12 * 4.3 / e.stiffness) << i;
  }
}

TEST_P(ExactEngine, FollowsAHarmonic) {
  const Engine& e = GetParam();
  for (const double ratio : {0.3, 0.999, 2.7}) {
    const double w = ratio * frequency();
    RunningSystem system(setup(InputSignal::harmonic(2.0, w, 0.4)), "exponential",
                         37 * kMillisecond);
    for (int i = 1; i <= 200; ++i) {
      ASSERT_EQ(system.run(1), StepStatus::kOk);
      const double expected =
          harmonicResponse(e.mass, e.damping, e.stiffness, 2.0, w, 0.4, system.time());
      // Near resonance without damping the two parts of the answer are a thousand times larger.
      const double size = 2.0 / e.stiffness / std::abs(1.0 - ratio * ratio);
      ASSERT_NEAR(system.q(0), expected, 1e-12 * size) << ratio << ", step " << i;
    }
  }
}

TEST_P(ExactEngine, FollowsAHarmonicAtResonance) {
  const Engine& e = GetParam();
  const double w = frequency();
  RunningSystem system(setup(InputSignal::harmonic(2.0, w, 0.0)), "exponential", 37 * kMillisecond);
  for (int i = 1; i <= 200; ++i) {
    ASSERT_EQ(system.run(1), StepStatus::kOk);
    const double t = system.time();
    const double expected = e.damping > 0.0
                                ? harmonicResponse(e.mass, e.damping, e.stiffness, 2.0, w, 0.0, t)
                                : 2.0 / (2.0 * e.mass * w) * t * std::sin(w * t);
    ASSERT_NEAR(system.q(0), expected, 1e-12 * 2.0 / (2.0 * e.mass * w) * (1.0 + t)) << i;
  }
}

TEST_P(ExactEngine, FollowsTablesWithInstantsInsideTheStep) {
  const Engine& e = GetParam();
  std::mt19937_64 random(11);
  for (const bool hold : {true, false}) {
    std::vector<std::int64_t> instants{3};
    std::vector<double> values{0.5};
    while (instants.back() < 4000 * kMillisecond) {
      instants.push_back(instants.back() + 1 +
                         std::uniform_int_distribution<std::int64_t>(0, 90 * kMillisecond)(random));
      values.push_back(std::uniform_real_distribution<double>(-5.0, 5.0)(random));
    }
    for (const int substeps : {1, 3}) {
      RunningSystem::Setup s = setup(InputSignal::table(instants, values, hold));
      s.substeps = substeps;
      RunningSystem system(s, "exponential", 37 * kMillisecond);
      const double start = system.energies().jacobi;
      ASSERT_EQ(system.run(100), StepStatus::kOk);
      const std::int64_t end = 100 * 37 * kMillisecond;
      Oscillator expected{e.mass, e.damping, e.stiffness};
      std::int64_t now = 0;
      for (std::size_t k = 0; now < end; ++k) {
        const std::int64_t next = std::min(instants[k], end);
        const std::size_t last = k == 0 ? 0 : k - 1;
        const bool flat = hold || k == 0;
        const long double duration = (instants[k] - instants[last]) / 1e9L;
        const long double slope = flat ? 0.0L : (values[k] - values[last]) / duration;
        expected.advance((next - now) / 1e9L, values[last], slope);
        now = next;
      }
      const double size = 5.0 / e.stiffness;
      EXPECT_NEAR(system.q(0), static_cast<double>(expected.x), 4e-12 * size)
          << hold << " " << substeps;
      EXPECT_NEAR(system.v(0), static_cast<double>(expected.v), 4e-12 * size * frequency());
      // The audit closes.
      EXPECT_NEAR(system.energies().jacobi - start, system.work(),
                  1e-12 * e.stiffness * size * size)
          << hold << " " << substeps;
    }
  }
}

INSTANTIATE_TEST_SUITE_P(
    Engines, ExactEngine,
    testing::Values(
        Engine{"Rotor",
               "jeffcott_rotor",
               "force_x",
               2.0,
               1.3,
               200.0,
               {{"mass", 2.0}, {"stiffness", 200.0}, {"damping", 1.3}},
               {}},
        Engine{"UndampedRotor",
               "jeffcott_rotor",
               "force_x",
               2.0,
               0.0,
               200.0,
               {{"mass", 2.0}, {"stiffness", 200.0}},
               {}},
        Engine{
            "Matrices", "linear_system", "force_q1", 2.0, 1.3, 200.0, {}, oneMass(2.0, 1.3, 200.0)},
        Engine{"UndampedMatrices",
               "linear_system",
               "force_q1",
               2.0,
               0.0,
               200.0,
               {},
               oneMass(2.0, 0.0, 200.0)},
        // K = mu m g / (a - mu h)
        Engine{"Plank",
               "friction_oscillator",
               "force",
               2.0,
               0.0,
               0.3 * 2.0 * 10.0 / 0.5,
               {{"mass", 2.0},
                {"friction_coefficient", 0.3},
                {"half_spacing", 0.5},
                {"height", 0.0},
                {"roller_speed", 1.0}},
               sliding()}),
    [](const auto& test) { return test.param.name; });

RunningSystem::Setup rotor() {
  RunningSystem::Setup s;
  s.model = "jeffcott_rotor";
  s.parameters = {{"mass", 2.0},    {"stiffness", 200.0},      {"stiffness_y", 300.0},
                  {"damping", 2.0}, {"internal_damping", 1.0}, {"eccentricity", 0.01}};
  s.speed = 5.0;
  s.q = {0.01, -0.02};
  return s;
}

RunningSystem::Setup disc() {
  RunningSystem::Setup s;
  s.model = "rigid_disc_rotor";
  s.parameters = {{"mass", 2.0},
                  {"polar_inertia", 0.05},
                  {"transverse_inertia", 0.03},
                  {"stiffness_displacement", 200.0},
                  {"stiffness_coupling", -5.0},
                  {"stiffness_rotation", 3.0},
                  {"damping_displacement", 2.0},
                  {"damping_rotation", 0.01},
                  {"eccentricity", 0.01}};
  s.speed = 5.0;
  s.q = {0.01, -0.02};
  return s;
}

double largestDifference(const RunningSystem& a, const RunningSystem& b) {
  const std::vector<double> x = a.state();
  const std::vector<double> y = b.state();
  double largest = 0.0;
  for (std::size_t i = 0; i < x.size(); ++i) {
    largest = std::max(largest, std::abs(x[i] - y[i]));
  }
  return largest;
}

TEST(InputsOfARunUp, AreExactAsFarAsTheRunUpIs) {
  for (RunningSystem::Setup s : {rotor(), disc()}) {
    s.profile = {{30.0, 8.0, 10.0, 0.5}, {10.0, 6.0, 0.0, 0.0}};
    s.inputs = {{"force_x", InputSignal::harmonic(3.0, 9.0, 0.4)},
                {"force_y", InputSignal::constant(-2.0)}};
    RunningSystem exact(s, "exponential", 2 * kMillisecond);
    RunningSystem fine(s, "gauss_legendre_6", 250000);
    const double start = exact.energies().jacobi;
    ASSERT_EQ(exact.run(3000), StepStatus::kOk);
    ASSERT_EQ(fine.run(24000), StepStatus::kOk);
    EXPECT_LT(largestDifference(exact, fine), 1e-9) << s.model;
    EXPECT_NEAR(exact.work(), fine.work(), 1e-9) << s.model;
    EXPECT_NEAR(exact.energies().jacobi - start, exact.work(), 1e-10) << s.model;
  }
}

TEST(InputsOfARunUp, AuditClosesAcrossCornersAndTheirErrorFallsWithTheStep) {
  RunningSystem::Setup s = disc();
  s.profile = {{30.0, 8.0, 10.0, 0.0}};
  s.inputs = {{"force_x", InputSignal::table({314159265, 1618033989}, {3.0, -4.0}, true)},
              {"force_y", InputSignal::table({271828183, 1414213562}, {-3.0, 4.0}, false)}};
  RunningSystem fine(s, "gauss_legendre_6", 250000);
  ASSERT_EQ(fine.run(8000), StepStatus::kOk);
  double before = 0.0;
  for (const int step : {8, 4, 2}) {
    RunningSystem exact(s, "exponential", step * kMillisecond);
    const double start = exact.energies().jacobi;
    ASSERT_EQ(exact.run(2000 / step), StepStatus::kOk);
    EXPECT_NEAR(exact.energies().jacobi - start, exact.work(), 1e-9) << step;
    const double error = largestDifference(exact, fine);
    EXPECT_LT(error, step == 8 ? 1e-5 : 0.2 * before) << step;
    before = error;
  }
}

TEST(Inputs, ForceThatTurnsWithTheShaftIsAnUnbalance) {
  const double m = 2.0;
  const double e = 0.01;
  const double w = 7.0;
  RunningSystem::Setup unbalanced;
  unbalanced.model = "jeffcott_rotor";
  unbalanced.parameters = {
      {"mass", m}, {"stiffness", 200.0}, {"damping", 2.0}, {"eccentricity", e}};
  unbalanced.speed = w;
  RunningSystem::Setup forced = unbalanced;
  forced.parameters["eccentricity"] = 0.0;
  forced.inputs = {{"force_x", InputSignal::harmonic(m * e * w * w, w, 0.0)},
                   {"force_y", InputSignal::harmonic(m * e * w * w, w, -0.5 * kPi)}};
  for (const char* method : {"exponential", "gauss_legendre_6"}) {
    RunningSystem a(unbalanced, method, kMillisecond);
    RunningSystem b(forced, method, kMillisecond);
    for (int i = 0; i < 100; ++i) {
      ASSERT_EQ(a.run(100), StepStatus::kOk);
      ASSERT_EQ(b.run(100), StepStatus::kOk);
      ASSERT_LT(largestDifference(a, b), 1e-12 * e * w) << method << " " << i;
    }
  }
}

TEST(Inputs, SupportIsTheModelsOwnSupport) {
  RunningSystem::Setup own;
  own.model = "cart_pendulum";
  own.parameters = {{"cart_mass", 2.0},        {"rod_mass", 0.5}, {"rod_length", 0.4},
                    {"stiffness", 50.0},       {"damping", 0.3},  {"support_amplitude", 0.1},
                    {"support_frequency", 4.0}};
  own.q = {0.0, 0.3};
  RunningSystem::Setup moved = own;
  moved.parameters["support_amplitude"] = 0.0;
  moved.inputs = {{"support", InputSignal::harmonic(0.1, 4.0, -0.5 * kPi)}};
  RunningSystem a(own, "dormand_prince_8", 4 * kMillisecond);
  RunningSystem b(moved, "dormand_prince_8", 4 * kMillisecond);
  ASSERT_EQ(a.run(2000), StepStatus::kOk);
  ASSERT_EQ(b.run(2000), StepStatus::kOk);
  EXPECT_LT(largestDifference(a, b), 1e-11);
}

TEST(Inputs, TorqueOnAFreeSpinAddsItsImpulseToTheAngularMomentum) {
  RunningSystem::Setup s;
  s.model = "free_rotor";
  s.parameters = {
      {"mass", 1.0}, {"stiffness", 400.0}, {"eccentricity", 0.01}, {"polar_inertia", 0.02}};
  s.inputs = {{"torque", InputSignal::table({0, 123456789, 777777777}, {0.1, -0.02, 0.05}, true)}};
  RunningSystem rotor(s, "gauss_legendre_6", kMillisecond);
  ASSERT_EQ(rotor.run(1000), StepStatus::kOk);
  const Eigen::Vector3d q(rotor.q(0), rotor.q(1), rotor.q(2));
  const Eigen::Vector3d v(rotor.v(0), rotor.v(1), rotor.v(2));
  const double impulse =
      0.1 * 0.123456789 - 0.02 * (0.777777777 - 0.123456789) + 0.05 * (1.0 - 0.777777777);
  EXPECT_NEAR(rotor.dynamics().momenta(q, v, {})[2], impulse, 1e-13);
}

TEST(Inputs, TorqueBetweenTheArmsIsTheSameInBothForms) {
  RunningSystem::Setup absolute;
  absolute.model = "double_pendulum";
  absolute.parameters = {{"mass1", 1.0}, {"mass2", 0.7}, {"length1", 1.0}, {"length2", 0.6}};
  absolute.q = {1.2, -0.4};
  absolute.inputs = {{"torque1", InputSignal::harmonic(2.0, 3.0, 0.0)},
                     {"torque2", InputSignal::constant(-1.5)}};
  RunningSystem::Setup relative = absolute;
  relative.settings.choices["coordinates"] = "relative";
  relative.q = {1.2, -1.6};
  RunningSystem a(absolute, "dormand_prince_8", kMillisecond);
  RunningSystem b(relative, "dormand_prince_8", kMillisecond);
  ASSERT_EQ(a.run(1000), StepStatus::kOk);
  ASSERT_EQ(b.run(1000), StepStatus::kOk);
  EXPECT_NEAR(a.q(0), b.q(0), 1e-11);
  EXPECT_NEAR(a.q(1), b.q(0) + b.q(1), 1e-11);
}

TEST(Inputs, TableOfOneValueAStepIsThoseCommands) {
  struct Driven {
    RunningSystem::Setup setup;
    const char* input;
    const char* method;
  };
  RunningSystem::Setup pendulum;
  pendulum.model = "double_pendulum";
  pendulum.parameters = {{"mass1", 1.0}, {"mass2", 0.7}, {"length1", 1.0}, {"length2", 0.6}};
  RunningSystem::Setup turning = disc();
  turning.profile = {{30.0, 8.0, 10.0, 0.0}};
  for (Driven d :
       {Driven{pendulum, "torque2", "gauss_legendre_6"}, Driven{rotor(), "force_y", "exponential"},
        Driven{turning, "force_x", "exponential"}, Driven{rotor(), "force_x", "runge_kutta_4"}}) {
    std::vector<std::int64_t> instants;
    std::vector<double> values;
    for (int i = 0; i < 200; ++i) {
      instants.push_back(i * 3 * kMillisecond);
      values.push_back(std::sin(1.7 * i));
    }
    RunningSystem::Setup commanded = d.setup;
    commanded.inputs = {{d.input, InputSignal::constant(0.0)}};
    d.setup.inputs = {{d.input, InputSignal::table(instants, values, true)}};
    RunningSystem a(d.setup, d.method, 3 * kMillisecond);
    RunningSystem b(commanded, d.method, 3 * kMillisecond);
    for (const double value : values) {
      ASSERT_TRUE(b.command(d.input, value, Inputs::kNever));
      ASSERT_EQ(a.run(1), StepStatus::kOk);
      ASSERT_EQ(b.run(1), StepStatus::kOk);
      ASSERT_EQ(a.state(), b.state()) << d.setup.model;
      ASSERT_EQ(a.work(), b.work()) << d.setup.model;
    }
  }
}

TEST(Inputs, AConstantThatIsZeroIsNoInput) {
  RunningSystem::Setup s = rotor();
  RunningSystem without(s, "gauss_legendre_6", kMillisecond);
  s.inputs = {{"force_x", InputSignal::constant(0.0)}};
  RunningSystem with(s, "gauss_legendre_6", kMillisecond);
  without.run(500);
  with.run(500);
  EXPECT_EQ(with.state(), without.state());
  EXPECT_EQ(with.work(), without.work());
}

}  // namespace model_inputs_test
}  // namespace whirl_twin

// Halving the step divides a method's error by 2^order, on free and on driven, nonlinear and
// linear, damped and undamped systems.
#include <gtest/gtest.h>

#include <cmath>
#include <ostream>

#include "running_system.h"

namespace whirl_twin {
namespace convergence_order_test {

// A shaft whose motion is smooth over the test: one piece of constant jerk.
const std::vector<SpeedMove> kSpeedingUp{{100.0, 60.0, 10.0, 0.0}};

RunningSystem::Setup spinningPendulum() {
  RunningSystem::Setup s;
  s.model = "spinning_pendulum";
  s.parameters = {{"mass", 0.5}, {"length", 0.2}, {"damping", 0.01}};
  s.speed = 5.0;
  s.profile = kSpeedingUp;
  s.q = {0.8};
  s.v = {1.0};
  return s;
}

RunningSystem::Setup doublePendulum() {
  RunningSystem::Setup s;
  s.model = "double_pendulum";
  s.parameters = {{"mass1", 1.0}, {"mass2", 0.7}, {"length1", 1.0}, {"length2", 0.6}};
  s.q = {1.2, -0.4};
  s.v = {0.0, 1.0};
  return s;
}

RunningSystem::Setup rotor() {
  RunningSystem::Setup s;
  s.model = "jeffcott_rotor";
  s.parameters = {{"mass", 2.0},    {"stiffness", 200.0},      {"stiffness_y", 300.0},
                  {"damping", 2.0}, {"internal_damping", 1.0}, {"eccentricity", 0.01}};
  s.speed = 5.0;
  s.profile = kSpeedingUp;
  s.q = {0.01, -0.02};
  return s;
}

/// The same, pushed by inputs that jump and kink at instants inside the steps.
RunningSystem::Setup pushedDoublePendulum() {
  RunningSystem::Setup s = doublePendulum();
  s.inputs = {{"torque1", InputSignal::table({314159265, 618033989}, {3.0, -4.0}, false)},
              {"torque2", InputSignal::table({271828183, 777777777}, {-3.0, 4.0}, true)}};
  return s;
}

RunningSystem::Setup pushedRotor() {
  RunningSystem::Setup s = rotor();
  s.inputs = {{"force_x", InputSignal::table({0, 314159265, 618033989}, {3.0, -4.0, 0.0}, true)},
              {"force_y", InputSignal::harmonic(5.0, 11.0, 0.4)}};
  return s;
}

struct Case {
  const char* name;
  const char* method;
  int order;
  RunningSystem::Setup (*setup)();
  std::int64_t coarsest;  // [ns]
};

void PrintTo(const Case& c, std::ostream* out) {
  *out << c.name;
}

constexpr std::int64_t kHorizon = 1024000000;  // [ns], a power of two of every step used

/// At the four quarters of the horizon: at one instant an error may happen to pass through zero.
std::vector<double> statesOf(const Case& c, const char* method, std::int64_t step) {
  RunningSystem system(c.setup(), method, step);
  std::vector<double> states;
  for (int quarter = 0; quarter < 4; ++quarter) {
    EXPECT_EQ(system.run(kHorizon / 4 / step), StepStatus::kOk);
    const std::vector<double> now = system.state();
    states.insert(states.end(), now.begin(), now.end());
  }
  return states;
}

class ConvergenceOrder : public testing::TestWithParam<Case> {};

/// Of steps of each length, against steps 16 times finer than any compared, by the method of
/// highest order: 1e-14 at worst.
std::vector<double> errorsOf(const Case& c, const std::vector<std::int64_t>& steps) {
  const std::vector<double> reference = statesOf(c, "gauss_legendre_6", 250000);
  std::vector<double> errors;
  for (const std::int64_t step : steps) {
    const std::vector<double> state = statesOf(c, c.method, step);
    errors.push_back(0.0);
    for (std::size_t i = 0; i < state.size(); ++i) {
      errors.back() = std::max(errors.back(), std::abs(state[i] - reference[i]));
    }
  }
  return errors;
}

TEST_P(ConvergenceOrder, IsTheMethodsOrder) {
  const Case& c = GetParam();
  const int halvings = c.order == 8 ? 2 : 3;  // order eight is soon at rounding
  std::vector<std::int64_t> steps;
  for (int i = 0; i <= halvings; ++i) {
    steps.push_back(c.coarsest >> i);
  }
  const std::vector<double> errors = errorsOf(c, steps);
  ASSERT_GT(errors.back(), 1e-13) << "rounding, not truncation: start with a coarser step";
  const double slopes = std::log2(errors.front() / errors.back());
  // Terms of the next order bend the slope by a few per cent at these steps.
  EXPECT_NEAR(slopes / halvings, c.order, 0.25);
}

constexpr std::int64_t kMillisecond = 1000000;

INSTANTIATE_TEST_SUITE_P(
    Methods, ConvergenceOrder,
    testing::Values(
        Case{"EulerOnSpinningPendulum", "semi_implicit_euler", 1, spinningPendulum, kMillisecond},
        Case{"EulerOnDoublePendulum", "semi_implicit_euler", 1, doublePendulum, kMillisecond},
        Case{"EulerOnRotor", "semi_implicit_euler", 1, rotor, kMillisecond},
        Case{"VerletOnSpinningPendulum", "velocity_verlet", 2, spinningPendulum, 4 * kMillisecond},
        Case{"VerletOnDoublePendulum", "velocity_verlet", 2, doublePendulum, 4 * kMillisecond},
        Case{"VerletOnRotor", "velocity_verlet", 2, rotor, 4 * kMillisecond},
        Case{"RungeKuttaOnSpinningPendulum", "runge_kutta_4", 4, spinningPendulum,
             16 * kMillisecond},
        Case{"RungeKuttaOnDoublePendulum", "runge_kutta_4", 4, doublePendulum, 4 * kMillisecond},
        Case{"RungeKuttaOnRotor", "runge_kutta_4", 4, rotor, 16 * kMillisecond},
        Case{"MidpointOnSpinningPendulum", "implicit_midpoint", 2, spinningPendulum,
             4 * kMillisecond},
        Case{"MidpointOnDoublePendulum", "implicit_midpoint", 2, doublePendulum, 4 * kMillisecond},
        Case{"MidpointOnRotor", "implicit_midpoint", 2, rotor, 4 * kMillisecond},
        Case{"GaussLegendre4OnSpinningPendulum", "gauss_legendre_4", 4, spinningPendulum,
             16 * kMillisecond},
        Case{"GaussLegendre4OnDoublePendulum", "gauss_legendre_4", 4, doublePendulum,
             16 * kMillisecond},
        Case{"GaussLegendre4OnRotor", "gauss_legendre_4", 4, rotor, 16 * kMillisecond},
        Case{"DormandPrinceOnSpinningPendulum", "dormand_prince_8", 8, spinningPendulum,
             128 * kMillisecond},
        Case{"DormandPrinceOnRotor", "dormand_prince_8", 8, rotor, 256 * kMillisecond},
        Case{"Stoermer6OnSpinningPendulum", "stoermer_6", 6, spinningPendulum, 8 * kMillisecond},
        Case{"Stoermer6OnDoublePendulum", "stoermer_6", 6, doublePendulum, 4 * kMillisecond},
        Case{"Stoermer6OnRotor", "stoermer_6", 6, rotor, 8 * kMillisecond},
        Case{"GaussLegendreOnSpinningPendulum", "gauss_legendre_6", 6, spinningPendulum,
             64 * kMillisecond},
        Case{"GaussLegendreOnDoublePendulum", "gauss_legendre_6", 6, doublePendulum,
             32 * kMillisecond},
        Case{"GaussLegendreOnRotor", "gauss_legendre_6", 6, rotor, 64 * kMillisecond},
        Case{"EulerOnPushedDoublePendulum", "semi_implicit_euler", 1, pushedDoublePendulum,
             kMillisecond},
        Case{"VerletOnPushedDoublePendulum", "velocity_verlet", 2, pushedDoublePendulum,
             4 * kMillisecond},
        Case{"RungeKuttaOnPushedDoublePendulum", "runge_kutta_4", 4, pushedDoublePendulum,
             4 * kMillisecond},
        Case{"RungeKuttaOnPushedRotor", "runge_kutta_4", 4, pushedRotor, 16 * kMillisecond},
        Case{"MidpointOnPushedRotor", "implicit_midpoint", 2, pushedRotor, 4 * kMillisecond},
        Case{"GaussLegendre4OnPushedDoublePendulum", "gauss_legendre_4", 4, pushedDoublePendulum,
             16 * kMillisecond},
        Case{"GaussLegendreOnPushedRotor", "gauss_legendre_6", 6, pushedRotor, 64 * kMillisecond}),
    [](const auto& test) { return test.param.name; });

class OrderOfALongPast : public testing::TestWithParam<Case> {};

// The start is by a fixed number of steps of order eight: its error falls with the ninth power of
// the step, the following error with the eleventh.
TEST_P(OrderOfALongPast, IsBetweenThatOfItsStartAndItsOwn) {
  const Case& c = GetParam();
  const std::vector<double> errors = errorsOf(c, {c.coarsest, c.coarsest / 2});
  ASSERT_GT(errors[1], 2e-14) << "rounding, not truncation: start with a coarser step";
  const double slope = std::log2(errors[0] / errors[1]);
  EXPECT_GT(slope, c.order - 0.25);
  EXPECT_LT(slope, 11.5);
}

INSTANTIATE_TEST_SUITE_P(
    Methods, OrderOfALongPast,
    testing::Values(Case{"OnSpinningPendulum", "stoermer", 9, spinningPendulum, 16 * kMillisecond},
                    Case{"OnDoublePendulum", "stoermer", 9, doublePendulum, 8 * kMillisecond},
                    Case{"OnRotor", "stoermer", 9, rotor, 16 * kMillisecond}),
    [](const auto& test) { return test.param.name; });

}  // namespace convergence_order_test
}  // namespace whirl_twin

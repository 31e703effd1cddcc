// Gauss-Legendre collocation: bounded energy error over long times, stiff systems by Newton's
// method, and an error where neither iteration converges.
#include <gtest/gtest.h>

#include <cmath>
#include <complex>
#include <string>

#include "running_system.h"

namespace whirl_twin {
namespace gauss_legendre_test {

using Complex = std::complex<double>;

RunningSystem::Setup doublePendulum(double mass2, std::vector<double> q, std::vector<double> v) {
  RunningSystem::Setup s;
  s.model = "double_pendulum";
  s.parameters = {{"mass1", 1.0}, {"mass2", mass2}, {"length1", 1.0}, {"length2", 1.0}};
  s.q = std::move(q);
  s.v = std::move(v);
  return s;
}

TEST(GaussLegendre6, EnergyErrorStaysBounded) {
  // Two thousand seconds of a double pendulum, regular motion, 25 steps a swing.
  RunningSystem pendulum(doublePendulum(1.0, {0.5, 0.3}, {0.0, 0.0}), "gauss_legendre_6", 40000000);
  const double start = pendulum.energies().jacobi;
  const auto largestError = [&](int rounds) {
    double largest = 0.0;
    for (int i = 0; i < rounds; ++i) {
      EXPECT_EQ(pendulum.run(7), StepStatus::kOk);
      largest = std::max(largest, std::abs(pendulum.energies().jacobi - start) / start);
    }
    return largest;
  };
  const double early = largestError(700);
  largestError(5600);
  const double late = largestError(700);
  EXPECT_GT(early, 1e-12) << "truncation is what is looked at, not rounding";
  EXPECT_LT(early, 1e-6);
  EXPECT_LT(late, 1.5 * early) << "the error oscillates and does not drift";
}

TEST(GaussLegendre6, RunsBackToWhereItCameFrom) {
  const RunningSystem::Setup there = doublePendulum(0.8, {1.0, -0.5}, {0.3, 0.0});
  RunningSystem forth(there, "gauss_legendre_6", 20000000);
  forth.run(500);
  // Time reversed: the same position, opposite rates.
  RunningSystem back(doublePendulum(0.8, {forth.q(0), forth.q(1)}, {-forth.v(0), -forth.v(1)}),
                     "gauss_legendre_6", 20000000);
  back.run(500);
  // A time-reversible method returns at any step; rounding grows with the motion's sensitivity.
  EXPECT_NEAR(back.q(0), there.q[0], 1e-10);
  EXPECT_NEAR(back.q(1), there.q[1], 1e-10);
  EXPECT_NEAR(-back.v(0), there.v[0], 1e-10);
}

/// The methods' stability functions: the diagonal Pade approximants of e^z.
Complex pade(int stages, const Complex& z) {
  switch (stages) {
    case 1:
      return (1.0 + 0.5 * z) / (1.0 - 0.5 * z);
    case 2:
      return (1.0 + z * (0.5 + z / 12.0)) / (1.0 - z * (0.5 - z / 12.0));
    default:
      return (1.0 + z * (0.5 + z * (0.1 + z / 120.0))) / (1.0 - z * (0.5 - z * (0.1 - z / 120.0)));
  }
}

class GaussLegendre : public testing::TestWithParam<int> {
 protected:
  const char* method() const {
    const char* const names[] = {"implicit_midpoint", "gauss_legendre_4", "gauss_legendre_6"};
    return names[GetParam() - 1];
  }
};

TEST_P(GaussLegendre, OnAStiffWhirlIsItsStabilityFunction) {
  // z'' + 2 zeta p z' + p^2 z = 0 in its eigenvalues: each part is multiplied by R(h s) every step.
  // Fixed-point iteration diverges above h p of about 3, so these steps are Newton's.
  for (const double hp : {5.0, 50.0, 500.0}) {
    for (const double zeta : {0.0, 0.05, 0.7}) {
      const double h = 0.01;
      const double p = hp / h;
      RunningSystem::Setup setup;
      setup.model = "jeffcott_rotor";
      setup.parameters = {{"mass", 1.0}, {"stiffness", p * p}, {"damping", 2.0 * zeta * p}};
      setup.q = {1.0, 0.3};
      setup.v = {0.2 * p, -0.5 * p};
      RunningSystem rotor(setup, method(), 10000000);
      const Complex s1 = p * Complex(-zeta, std::sqrt(1.0 - zeta * zeta));
      const Complex s2 = std::conj(s1);
      const Complex z0(1.0, 0.3);
      const Complex v0(0.2 * p, -0.5 * p);
      const Complex a1 = (v0 - s2 * z0) / (s1 - s2);
      const Complex a2 = z0 - a1;
      for (int steps = 1; steps <= 20; ++steps) {
        ASSERT_EQ(rotor.run(1), StepStatus::kOk) << "h p = " << hp;
        const Complex z = a1 * std::pow(pade(GetParam(), h * s1), steps) +
                          a2 * std::pow(pade(GetParam(), h * s2), steps);
        ASSERT_NEAR(rotor.q(0), z.real(), 1e-10) << "h p = " << hp << ", zeta = " << zeta;
        ASSERT_NEAR(rotor.q(1), z.imag(), 1e-10) << "h p = " << hp << ", zeta = " << zeta;
      }
    }
  }
}

INSTANTIATE_TEST_SUITE_P(Stages, GaussLegendre, testing::Values(1, 2, 3),
                         [](const auto& test) { return std::to_string(test.param); });

TEST(GaussLegendre6, FollowsTheSlowSwingOfAStiffDoublePendulum) {
  // m2 >> m1: the slow swing is that of one pendulum of two metres, and across it the upper bob
  // sings at p2 = sqrt(2 g m2/m1) rad/s, h p2 = 4.4 and 44. Started nearly straight, p2 is excited
  // by (p1/p2)^2 of the swing, and its phase is not resolved at these steps.
  for (const double ratio : {1e4, 1e6}) {
    const std::vector<double> q{0.2, 0.2};
    RunningSystem coarse(doublePendulum(ratio, q, {0.0, 0.0}), "gauss_legendre_6", 10000000);
    RunningSystem fine(doublePendulum(ratio, q, {0.0, 0.0}), "gauss_legendre_6", 100000);
    ASSERT_EQ(coarse.run(500), StepStatus::kOk);
    ASSERT_EQ(fine.run(50000), StepStatus::kOk);
    EXPECT_NEAR(coarse.q(0), fine.q(0), 1e-4) << ratio;
    EXPECT_NEAR(coarse.q(1), fine.q(1), 1e-4) << ratio;
    EXPECT_NEAR(coarse.energies().jacobi, fine.energies().jacobi, 1e-6 * fine.energies().jacobi);
  }
}

TEST(GaussLegendre6, RefusesAStepItCannotSolveAndKeepsTheState) {
  // Thousands of turns within one step: no polynomial of three stages follows them.
  RunningSystem pendulum(doublePendulum(1.0, {1.0, 2.0}, {3000.0, -5000.0}), "gauss_legendre_6",
                         1000000000);
  const std::vector<double> before = pendulum.state();
  EXPECT_NE(pendulum.run(1), StepStatus::kOk);  // not converged, or no longer finite
  EXPECT_EQ(pendulum.state(), before);
}

}  // namespace gauss_legendre_test
}  // namespace whirl_twin

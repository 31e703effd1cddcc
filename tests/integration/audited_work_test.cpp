// The audited work of a method is the integral of dh/dt: the exact step's, in closed form, is that
// of Gauss-Legendre with far smaller steps, and both equal the gain of the Jacobi integral.
#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "running_system.h"

namespace whirl_twin {
namespace audited_work_test {

RunningSystem::Setup randomRotor(std::mt19937_64& random, bool rotating_damping) {
  const auto between = [&](double low, double high) {
    return std::uniform_real_distribution<double>(low, high)(random);
  };
  RunningSystem::Setup s;
  const double m = between(0.5, 5.0);
  const double p = between(5.0, 50.0);
  s.model = "jeffcott_rotor";
  s.parameters = {{"mass", m},
                  {"stiffness", m * p * p},
                  {"stiffness_y", m * p * p * between(0.5, 2.0)},
                  {"damping", m * p * between(0.0, 0.5)},
                  {"damping_y", m * p * between(0.0, 0.5)},
                  {"internal_damping", rotating_damping ? m * p * between(0.0, 0.1) : 0.0},
                  {"eccentricity", 1e-3},
                  {"eccentricity_angle", between(-3.0, 3.0)}};
  s.speed = p * between(-2.0, 2.0);
  s.q = {between(-1e-2, 1e-2), between(-1e-2, 1e-2)};
  s.v = {p * between(-1e-2, 1e-2), p * between(-1e-2, 1e-2)};
  return s;
}

TEST(AuditedWork, OfTheExactStepIsThatOfManySmallOnes) {
  std::mt19937_64 random(1847);
  for (int i = 0; i < 40; ++i) {
    const RunningSystem::Setup setup = randomRotor(random, i % 2 == 0);
    RunningSystem exact(setup, "exponential", 100000000);
    RunningSystem fine(setup, "gauss_legendre_6", 500000);
    const Energies start = exact.energies();
    const double scale = start.kinetic + start.potential;
    exact.run(10);
    fine.run(2000);
    // p h = 0.035 at most for the fine steps: (p h)^6 / 1e5 relative.
    EXPECT_NEAR(exact.work(), fine.work(), 1e-12 * scale) << "rotor " << i;
    EXPECT_NEAR(exact.energies().jacobi - start.jacobi, exact.work(), 1e-12 * scale)
        << "rotor " << i;
  }
}

TEST(AuditedWork, IsTheHeatOfAFreeDampedSwing) {
  // A hanging pendulum that comes to rest has dissipated all its energy.
  RunningSystem::Setup s;
  s.model = "spinning_pendulum";
  s.parameters = {{"mass", 1.0}, {"length", 1.0}, {"damping", 2.0}};
  s.q = {1.0};
  // Order 6, and order 4 at p h = 0.003.
  for (const auto& [method, tolerance] :
       {std::pair("gauss_legendre_6", 1e-12), std::pair("runge_kutta_4", 1e-10)}) {
    RunningSystem pendulum(s, method, 1000000);
    const double start = pendulum.energies().jacobi;
    ASSERT_EQ(pendulum.run(60000), StepStatus::kOk);
    // e^-60 of the swing's energy remains.
    EXPECT_NEAR(pendulum.work(), -start, tolerance * start) << method;
  }
}

TEST(AuditedWork, OfAnUndampedPendulumIsNothing) {
  RunningSystem::Setup s;
  s.model = "double_pendulum";
  s.parameters = {{"mass1", 1.0}, {"mass2", 2.0}, {"length1", 1.0}, {"length2", 0.5}};
  s.q = {1.0, 0.5};
  RunningSystem pendulum(s, "gauss_legendre_6", 10000000);
  const double start = pendulum.energies().jacobi;
  pendulum.run(1000);
  // Rounding of forces that cancel: a thousand steps of 1e-16 of the power passing through.
  EXPECT_NEAR(pendulum.work(), 0.0, 1e-13 * start);
}

}  // namespace audited_work_test
}  // namespace whirl_twin

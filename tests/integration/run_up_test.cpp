// While the speed changes the exponential step integrates the unbalance by quadrature with as many
// nodes as the step needs: on the motion of far finer Gauss-Legendre steps through the critical
// speed.
#include <gtest/gtest.h>

#include <cmath>

#include "running_system.h"

namespace whirl_twin {
namespace run_up_test {

constexpr double kP = 40.0;  // [rad/s]

RunningSystem::Setup rotor(std::vector<SpeedMove> profile, double speed) {
  RunningSystem::Setup s;
  s.model = "jeffcott_rotor";
  s.parameters = {{"mass", 1.5},
                  {"stiffness", 1.5 * kP * kP},
                  {"stiffness_y", 1.7 * kP * kP},
                  {"damping", 1.5 * 2.0 * 0.03 * kP},
                  {"eccentricity", 1e-4},
                  {"eccentricity_angle", 0.3}};
  s.speed = speed;
  s.profile = std::move(profile);
  return s;
}

double distance(const RunningSystem& a, const RunningSystem& b) {
  double largest = 0.0;
  for (std::size_t i = 0; i < 2; ++i) {
    largest = std::max(largest, std::abs(a.q(i) - b.q(i)));
    largest = std::max(largest, std::abs(a.v(i) - b.v(i)) / kP);
  }
  return largest;
}

TEST(RunUp, IsExactAtAnyStep) {
  // One piece of constant jerk through the critical speed: 20 rad/s to 69 rad/s in 1.024 s.
  const RunningSystem::Setup setup = rotor(
      {
          {1000.0, 1000.0, 30.0, 0.0},
      },
      20.0);
  const std::int64_t horizon = 1024000000;
  RunningSystem reference(setup, "gauss_legendre_6", 250000);
  reference.run(horizon / 250000);
  for (const std::int64_t step : {1000000, 16000000, 32000000, 64000000, 256000000}) {
    RunningSystem run(setup, "exponential", step);
    EXPECT_EQ(run.run(horizon / step), StepStatus::kOk);
    // The reference itself is good to 1e-16 m or so; radii are 1e-4 m.
    EXPECT_LT(distance(run, reference), 1e-15) << step << " ns";
  }
}

/// Largest distance between exact steps of a millisecond and Gauss-Legendre's of a sixteenth of it,
/// relative to the largest radius, through the critical speed and back.
double largestDistance(const std::vector<SpeedMove>& profile) {
  RunningSystem fine(rotor(profile, 5.0), "gauss_legendre_6", 62500);
  RunningSystem exact(rotor(profile, 5.0), "exponential", 1000000);
  double radius = 0.0;
  double largest = 0.0;
  for (int i = 0; i < 40; ++i) {
    fine.run(1600);
    exact.run(100);
    radius = std::max(radius, std::hypot(fine.q(0), fine.q(1)));
    largest = std::max(largest, distance(fine, exact));
  }
  EXPECT_GT(radius, 3e-4) << "the critical speed was crossed";
  return largest / radius;
}

// The profiles change between constant and changing speed inside a step: steps are split there, so
// that a breakpoint of the drive costs no accuracy.
TEST(RunUp, WithDwellsIsTheFineGaussLegendreMotion) {
  EXPECT_LT(largestDistance({{90.0, 60.0, 300.0, 0.3}, {10.0, 100.0, 500.0, 0.2}}), 1e-12);
}

TEST(RunUp, AtConstantAccelerationLosesNothingAtTheCorners) {
  EXPECT_LT(largestDistance({{90.0, 60.0, 0.0, 0.30041}, {10.0, 100.0, 0.0, 0.20013}}), 1e-12);
}

TEST(RunUp, WorkOfTheStepsIsTheWorkOfTheMotion) {
  const RunningSystem::Setup setup = rotor({{1000.0, 1000.0, 30.0, 0.0}}, 20.0);
  RunningSystem exact(setup, "exponential", 1000000);
  const double start = exact.energies().jacobi;
  double scale = 0.0;
  for (int i = 0; i < 100; ++i) {
    exact.run(10);
    const Energies e = exact.energies();
    scale = std::max(scale, e.kinetic + e.potential);
    // (w h)^6 of Lobatto quadrature and Hermite interpolation at w h = 0.07, and less.
    EXPECT_NEAR(e.jacobi - start, exact.work(), 1e-10 * scale) << "at " << exact.time() << " s";
  }
}

TEST(RotatingDamping, AtConstantSpeedIsExactToo) {
  for (const double speed : {30.0, 100.0, 130.0}) {
    RunningSystem::Setup setup = rotor({}, speed);
    setup.parameters["internal_damping"] = 2.0;
    RunningSystem fine(setup, "gauss_legendre_6", 100000);
    RunningSystem exact(setup, "exponential", 20000000);
    double radius = 0.0;
    for (int i = 0; i < 10; ++i) {
      fine.run(2000);
      exact.run(10);
      radius = std::max(radius, std::hypot(fine.q(0), fine.q(1)));
      EXPECT_LT(distance(fine, exact), 1e-12 * radius) << speed << " rad/s";
    }
  }
}

}  // namespace run_up_test
}  // namespace whirl_twin

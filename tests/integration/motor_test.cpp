// A rotor whose spin is free: Sommerfeld's effect against the reference runs, what is conserved,
// and the same physics as free_rotor has in its turning frame.
#include <gtest/gtest.h>

#include <cmath>

#include "running_system.h"

namespace whirl_twin {
namespace {

constexpr std::int64_t kMillisecond = 1000000;

// Reference case G01: m, k, c, e, Jp; no-load speed 400 rad/s.
constexpr double kMass = 5.0;
constexpr double kStiffness = 2.0e5;
constexpr double kDamping = 40.0;
constexpr double kEccentricity = 2.0e-4;
constexpr double kNoLoad = 400.0;

RunningSystem::Setup sommerfeld(double stall_torque, double speed = 0.0) {
  RunningSystem::Setup s;
  s.model = "jeffcott_rotor";
  s.parameters = {{"mass", kMass},
                  {"stiffness", kStiffness},
                  {"damping", kDamping},
                  {"eccentricity", kEccentricity},
                  {"polar_inertia", 0.02}};
  s.motor = Motor::falling(stall_torque, kNoLoad);
  s.v = {0.0, 0.0, speed};
  return s;
}

/// 1.5 ms: a seventh of a turn at the critical speed, where order 6 leaves 1e-7 a turn.
constexpr std::int64_t kStep = 3 * kMillisecond / 2;

TEST(Motor, TooWeakItIsCapturedBelowTheCriticalSpeed) {
  RunningSystem rotor(sommerfeld(0.3), "gauss_legendre_6", kStep);
  ASSERT_EQ(rotor.run(26667), StepStatus::kOk);  // 40 s
  EXPECT_NEAR(rotor.v(2), 197.90070944526, 1e-4 * 197.9);
  EXPECT_NEAR(std::hypot(rotor.q(0), rotor.q(1)), 4.375819053e-3, 1e-3 * 4.376e-3);
}

TEST(Motor, HasItsUpperSteadySpeedTooWhereItStartsBeyondTheResonance) {
  RunningSystem rotor(sommerfeld(0.3, 390.0), "gauss_legendre_6", kMillisecond);
  // It approaches as exp(-t T0 / (w0 J)), J/26 s: 400 s leave 3e-7 of 8.5 rad/s.
  ASSERT_EQ(rotor.run(400000), StepStatus::kOk);
  EXPECT_NEAR(rotor.v(2), 398.4820931548651, 1e-5);
}

TEST(Motor, EscapesFromTheTorqueThatTheReferenceRunsBracket) {
  RunningSystem captured(sommerfeld(0.40078125 * 0.998), "gauss_legendre_6", kStep);
  RunningSystem passing(sommerfeld(0.40195312499999997 * 1.002), "gauss_legendre_6", kStep);
  ASSERT_EQ(captured.run(26667), StepStatus::kOk);
  ASSERT_EQ(passing.run(26667), StepStatus::kOk);
  EXPECT_LT(captured.v(2), 200.0);
  EXPECT_GT(passing.v(2), 210.0);
}

TEST(Motor, WithoutTorqueAndDampingAngularMomentumIsConserved) {
  RunningSystem::Setup s = sommerfeld(0.0, 180.0);
  s.parameters["damping"] = 0.0;
  s.parameters["internal_damping"] = 30.0;  // acts between disc and shaft: inside
  s.motor = Motor::constant(0.0);
  s.q = {2.0e-3, -1.0e-3, 0.3};
  RunningSystem rotor(s, "gauss_legendre_6", kMillisecond / 2);
  const auto momentum = [&] {
    const double c = kEccentricity * std::cos(rotor.q(2));
    const double d = kEccentricity * std::sin(rotor.q(2));
    const double gx = rotor.q(0) + c;
    const double gy = rotor.q(1) + d;
    const double vx = rotor.v(0) - rotor.v(2) * d;
    const double vy = rotor.v(1) + rotor.v(2) * c;
    return kMass * (gx * vy - gy * vx) + 0.02 * rotor.v(2);
  };
  const double before = momentum();
  const double energy = rotor.energies().jacobi;
  ASSERT_EQ(rotor.run(20000), StepStatus::kOk);
  EXPECT_NEAR(momentum(), before, 1e-9 * before);
  EXPECT_LT(rotor.energies().jacobi, 0.999 * energy) << "rotating damping takes energy";
}

// free_rotor has the same rotor in xi, eta, turning with it.
TEST(Motor, MovesAsTheFreeRotorOfTheTurningFrame) {
  const ParameterValues disc{{"mass", 2.0},
                             {"stiffness", 200.0},
                             {"damping", 2.0},
                             {"eccentricity", 0.01},
                             {"polar_inertia", 0.02}};
  RunningSystem::Setup fixed;
  fixed.model = "jeffcott_rotor";
  fixed.parameters = disc;
  fixed.motor = Motor::constant(0.25, 1.0e-4);
  fixed.q = {0.02, -0.01, 0.0};
  fixed.v = {0.0, 0.1, 2.0};
  RunningSystem::Setup turning;
  turning.model = "free_rotor";
  turning.parameters = disc;
  turning.parameters["torque"] = 0.25;
  turning.parameters["drag"] = 1.0e-4;
  turning.q = {0.02, -0.01, 0.0};
  turning.v = {2.0 * -0.01, 0.1 - 2.0 * 0.02, 2.0};
  RunningSystem a(fixed, "gauss_legendre_6", kMillisecond);
  RunningSystem b(turning, "gauss_legendre_6", kMillisecond);
  ASSERT_EQ(a.run(5000), StepStatus::kOk);
  ASSERT_EQ(b.run(5000), StepStatus::kOk);
  const double c = std::cos(b.q(2));
  const double d = std::sin(b.q(2));
  EXPECT_NEAR(a.q(0), b.q(0) * c - b.q(1) * d, 1e-9 * 0.02);
  EXPECT_NEAR(a.q(1), b.q(0) * d + b.q(1) * c, 1e-9 * 0.02);
  EXPECT_NEAR(a.v(2), b.v(2), 1e-9 * b.v(2));
}

// The spin is kept as turns and a remainder: 1e9 rad on, the whirl is the one of the first turn.
TEST(Motor, LosesNoPhaseHoweverOftenItHasTurned) {
  RunningSystem::Setup near = sommerfeld(0.3, 150.0);
  RunningSystem::Setup far = near;
  const double turns = 159154943.0;
  near.q = {0.0, 0.0, 0.0};
  far.q = {0.0, 0.0, turns * 6.283185307179586};
  // What this product is, less whole turns: 2 pi as a double is 2.449e-16 short.
  near.q[2] = std::fma(turns, 6.283185307179586, -far.q[2]) * -1.0 - turns * 2.4492935982947064e-16;
  RunningSystem a(near, "gauss_legendre_6", kMillisecond);
  RunningSystem b(far, "gauss_legendre_6", kMillisecond);
  ASSERT_EQ(a.run(3000), StepStatus::kOk);
  ASSERT_EQ(b.run(3000), StepStatus::kOk);
  EXPECT_NEAR(b.q(0), a.q(0), 1e-12 * kEccentricity);
  EXPECT_NEAR(b.q(1), a.q(1), 1e-12 * kEccentricity);
}

}  // namespace
}  // namespace whirl_twin

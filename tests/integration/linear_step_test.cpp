// Steps of a linear system given by its matrices: the fixed-step methods in another form, each of
// its order, with a closed energy balance, and without allocating.
#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <map>
#include <stdexcept>

#include "allocation_guard.h"
#include "integration/dormand_prince_8.h"
#include "integration/erased_ode.h"
#include "integration/exponential.h"
#include "integration/gauss_legendre.h"
#include "integration/linear_methods.h"
#include "integration/linear_stepper.h"
#include "integration/runge_kutta_4.h"
#include "integration/semi_implicit_euler.h"
#include "integration/velocity_verlet.h"
#include "linear_systems.h"
#include "mechanics/rotors/jeffcott_rotor.h"

namespace whirl_twin {
namespace linear_step_test {

using Eigen::VectorXd;

constexpr double kSpeed = 17.0;  // rad/s

JeffcottRotor rotorOf(double eccentricity) {
  JeffcottRotor rotor;
  rotor.mass = 2.0;
  rotor.stiffness = 300.0;
  rotor.stiffness_y = 500.0;
  rotor.damping = 3.0;
  rotor.damping_y = 4.0;
  rotor.internal_damping = 1.5;
  rotor.eccentricity = eccentricity;
  rotor.eccentricity_angle = 0.6;
  return rotor;
}

LinearModel matricesOf(const JeffcottRotor& rotor) {
  LinearModel model = freeMasses(2);
  const double whirling = rotor.internal_damping * kSpeed;
  model.mass *= rotor.mass;
  model.stiffness.diagonal() << rotor.stiffness, rotor.stiffness_y;
  model.damping.diagonal() << rotor.damping + rotor.internal_damping,
      rotor.damping_y + rotor.internal_damping;
  model.circulatory << 0.0, whirling, -whirling, 0.0;
  const double unbalance = rotor.mass * rotor.eccentricity * kSpeed * kSpeed;
  // cos of the heavy spot's angle along x, sin along y.
  model.forces = {{VectorXd::Unit(2, 0) * unbalance, kSpeed, rotor.eccentricity_angle},
                  {VectorXd::Unit(2, 1) * unbalance, kSpeed,
                   rotor.eccentricity_angle - 0.5 * 3.14159265358979323846}};
  return model;
}

template <class Method>
class SameMethod : public testing::Test {};
using Methods =
    testing::Types<SemiImplicitEuler, VelocityVerlet, RungeKutta4, DormandPrince8,
                   ImplicitMidpoint<2>, GaussLegendre4<2>, GaussLegendre6<2>, Exponential<2>>;
TYPED_TEST_SUITE(SameMethod, Methods);

TYPED_TEST(SameMethod, OfMatricesAsOfEnergies) {
  const double h = 1.0 / 256.0;  // p h = 0.06
  constexpr long kSteps = 512;
  for (const double eccentricity : {0.0, 0.01}) {
    const JeffcottRotor rotor = rotorOf(eccentricity);
    MotionState<2> fixed;
    fixed.q = {0.02, -0.05};
    fixed.v = {0.3, 0.1};
    TypeParam method;
    Drive drive(kSpeed, 0.0);
    for (long i = 0; i < kSteps; ++i) {
      drive.begin(i * 3906250);  // [ns]: h
      const DrivenEquation<JeffcottRotor> equation{rotor, drive, static_cast<double>(i) * h};
      ASSERT_EQ(method.step(equation, 0.0, h, fixed), StepStatus::kOk);
    }
    const LinearModel model = matricesOf(rotor);
    LinearMotion motion(2);
    motion.q() << 0.02, -0.05;
    motion.v() << 0.3, 0.1;
    motion = after(model, TypeParam::kName, h, kSteps, motion);
    // 512 steps of rounding, 1e-16 each of what a step adds to states of size 0.05 and 0.5.
    for (std::size_t i = 0; i < 2; ++i) {
      EXPECT_NEAR(motion.q()[static_cast<Eigen::Index>(i)], fixed.q[i], 1e-14);
      EXPECT_NEAR(motion.v()[static_cast<Eigen::Index>(i)], fixed.v[i], 1e-13);
    }
    if (eccentricity == 0.0) {  // with it the Jacobi integrals differ: the shaft's work is in one
      EXPECT_NEAR(motion.work.high, fixed.work.high, 1e-14);
    }
  }
}

class LinearMethod : public testing::TestWithParam<std::string> {};

int orderOf(const std::string& method) {
  static const std::map<std::string, int> orders{
      {"semi_implicit_euler", 1}, {"velocity_verlet", 2},  {"implicit_midpoint", 2},
      {"runge_kutta_4", 4},       {"gauss_legendre_4", 4}, {"gauss_legendre_6", 6},
      {"dormand_prince_8", 8},    {"exponential", 1000}};
  return orders.at(method);
}

double errorAfterASecond(const LinearModel& model, const std::string& method, long steps) {
  const LinearMotion start = startOf(model);
  const LinearMotion exact = after(model, "exponential", 1.0, 1, start);
  const LinearMotion found = after(model, method, 1.0 / static_cast<double>(steps), steps, start);
  return (found.q() - exact.q()).norm() + 0.1 * (found.v() - exact.v()).norm();
}

TEST_P(LinearMethod, HasItsOrder) {
  if (GetParam() == "exponential") {
    // No truncation error: every step is as good.
    for (const long steps : {2L, 50L, 1000L}) {
      EXPECT_LT(errorAfterASecond(fullSystem(5), GetParam(), steps), 1e-12) << steps;
    }
    return;
  }
  // p h = 0.1 and 0.05 (of order eight 0.8 and 0.4, above rounding): the next term of the error is
  // that much smaller or its square, so the order shows to 0.2.
  const long steps = orderOf(GetParam()) == 8 ? 12 : 100;
  const double coarse = errorAfterASecond(fullSystem(5), GetParam(), steps);
  const double fine = errorAfterASecond(fullSystem(5), GetParam(), 2 * steps);
  EXPECT_NEAR(std::log2(coarse / fine), orderOf(GetParam()), 0.2) << coarse << ", " << fine;
}

TEST_P(LinearMethod, CountsTheWorkOfItsForces) {
  // The audited work against what T + V gained: exact for Gauss-Legendre with three stages and
  // exponential, else of the method's order: errors of (p h)^order, p h = 0.01, of the energy.
  const LinearModel model = fullSystem(5);
  const LinearMotion start = startOf(model);
  const LinearMotion end = after(model, GetParam(), 1e-3, 3000, start);
  const double gained = energy(model, end) - energy(model, start);
  const int order = orderOf(GetParam());
  const double tolerance = order >= 6 ? 1e-12 : 10.0 * std::pow(0.01, order);
  EXPECT_NEAR(end.work.high, gained, tolerance * energy(model, start));
}

TEST_P(LinearMethod, DoesNoWorkOnAConservativeSystem) {
  LinearModel model = fullSystem(4);
  model.damping.setZero();
  model.circulatory.setZero();
  model.forces.clear();
  const LinearMotion end = after(model, GetParam(), 1e-3, 100, startOf(model));
  EXPECT_EQ(end.work.high, 0.0);
}

TEST_P(LinearMethod, DoesNotAllocateInAStep) {
  for (const Eigen::Index n : {1, 3, 40}) {
    const LinearModel model = fullSystem(n);
    LinearStep step(model, GetParam(), 1e-3);
    LinearMotion motion = startOf(model);
    const AllocationGuard guard;
    for (int i = 0; i < 100; ++i) {
      step.advance(i * 1e-3, motion);
    }
    EXPECT_EQ(guard.allocations(), 0u) << n << " coordinates";
  }
}

TEST_P(LinearMethod, GivesNoNumberBeyondTheRangeOfDoubles) {
  LinearModel model = freeMasses(2);
  model.mass *= 1e-200;
  model.stiffness = 1e200 * Eigen::MatrixXd::Identity(2, 2);
  const LinearMotion end = after(model, GetParam(), 1e-3, 1, startOf(model));
  EXPECT_FALSE(end.q().allFinite());
}

INSTANTIATE_TEST_SUITE_P(All, LinearMethod, testing::ValuesIn(linearMethodNames()),
                         [](const auto& test) { return test.param; });

TEST(LinearStep, RefusesAMethodItDoesNotKnow) {
  EXPECT_THROW(LinearStep(freeMasses(1), "euler", 1e-3), std::logic_error);
}

TEST(LinearGaussLegendre, KeepsTheEnergyOfAnUndampedGyroscopicSystem) {
  // Quadratic invariants are its own: rounding only, after 1e5 steps of p h = 1.
  LinearModel model = fullSystem(5);
  model.damping.setZero();
  model.circulatory.setZero();
  model.forces.clear();
  const LinearMotion start = startOf(model);
  const LinearMotion end = after(model, "gauss_legendre_6", 0.1, 100000, start);
  EXPECT_NEAR(energy(model, end), energy(model, start), 1e-11 * energy(model, start));
}

}  // namespace linear_step_test
}  // namespace whirl_twin

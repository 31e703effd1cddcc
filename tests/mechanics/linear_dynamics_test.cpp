// A linear system given by its matrices agrees with the same system given by its energies, and
// satisfies the balance of energy and of momentum.
#include "mechanics/linear_dynamics.h"

#include <gtest/gtest.h>

#include <cmath>
#include <stdexcept>

#include "mechanics/lagrangian_dynamics.h"
#include "mechanics/rotors/jeffcott_rotor.h"
#include "messages/input_error.h"

namespace whirl_twin {
namespace linear_dynamics_test {

using Eigen::MatrixXd;
using Eigen::VectorXd;

LinearModel freeModel(Eigen::Index n) {
  LinearModel model;
  model.model = "linear_system";
  for (Eigen::Index i = 0; i < n; ++i) {
    model.coordinates.push_back({"q" + std::to_string(i + 1), "m"});
  }
  model.mass = MatrixXd::Identity(n, n);
  model.damping = model.gyroscopic = model.stiffness = model.circulatory = MatrixXd::Zero(n, n);
  return model;
}

/// Five coordinates, every matrix full, a constant and two alternating forces.
LinearModel fullModel() {
  constexpr Eigen::Index kDof = 5;
  std::srand(1919);  // what Eigen's Random draws from
  const MatrixXd a = MatrixXd::Random(kDof, kDof);
  const MatrixXd b = MatrixXd::Random(kDof, kDof);
  const MatrixXd c = MatrixXd::Random(kDof, kDof);
  LinearModel model = freeModel(kDof);
  model.mass = a * a.transpose() + MatrixXd::Identity(kDof, kDof);
  model.damping = 0.1 * b * b.transpose();
  model.gyroscopic = b - b.transpose();
  model.stiffness = 20.0 * c * c.transpose();
  model.circulatory = 0.3 * (c - c.transpose());
  model.forces = {{VectorXd::Random(kDof), 0.0, 0.4},
                  {VectorXd::Random(kDof), 3.0, -0.7},
                  {VectorXd::Random(kDof), 7.0, 0.0}};
  return model;
}

TEST(LinearDynamics, OfARotorsMatricesIsTheRotor) {
  JeffcottRotor rotor;
  rotor.mass = 2.0;
  rotor.stiffness = 300.0;
  rotor.stiffness_y = 500.0;
  rotor.damping = 3.0;
  rotor.damping_y = 4.0;
  rotor.internal_damping = 1.5;
  const double speed = 20.0;
  const double whirling = rotor.internal_damping * speed;
  LinearModel model = freeModel(2);
  model.mass *= rotor.mass;
  model.stiffness.diagonal() << rotor.stiffness, rotor.stiffness_y;
  model.damping.diagonal() << rotor.damping + rotor.internal_damping,
      rotor.damping_y + rotor.internal_damping;
  model.circulatory << 0.0, whirling, -whirling, 0.0;
  const LinearDynamics linear(model);
  const LagrangianDynamics<JeffcottRotor> energies(rotor);
  const EvaluationPoint<double> at{0.3, 0.8, speed, 0.0};
  const VectorXd q = (VectorXd(2) << 0.01, -0.03).finished();
  const VectorXd v = (VectorXd(2) << 0.2, 0.5).finished();
  // Sums of a few products: rounding only.
  EXPECT_TRUE(linear.acceleration(q, v, at).isApprox(energies.acceleration(q, v, at), 1e-14));
  EXPECT_TRUE(linear.momenta(q, v, at).isApprox(energies.momenta(q, v, at), 1e-14));
  EXPECT_TRUE(linear.residualForce(q, v, at).isApprox(energies.residualForce(q, v, at), 1e-14));
  EXPECT_TRUE(linear.appliedForce(q, v, at).isApprox(energies.appliedForce(q, v, at), 1e-14));
  const Energies mine = linear.energies(q, v, at);
  const Energies theirs = energies.energies(q, v, at);
  EXPECT_NEAR(mine.kinetic, theirs.kinetic, 1e-14);
  EXPECT_NEAR(mine.potential, theirs.potential, 1e-14);
  EXPECT_NEAR(mine.jacobi, theirs.jacobi, 1e-14);
  // Rotating damping is one dissipation function there, a damping and a circulatory matrix here.
  EXPECT_NEAR(mine.input_power - mine.dissipated_power,
              theirs.input_power - theirs.dissipated_power, 1e-13);
  const Linearization l = energies.linearization(q, v, VectorXd::Zero(2), at);
  const Linearization mine_l = linear.linearization(q, v, VectorXd::Zero(2), at);
  EXPECT_TRUE(mine_l.damping.isApprox(l.damping, 1e-14));
  EXPECT_TRUE(mine_l.circulatory.isApprox(l.circulatory, 1e-14));
  EXPECT_TRUE(mine_l.stiffness.isApprox(l.stiffness, 1e-14));
}

TEST(LinearDynamics, GainsTheEnergyThatForcesBringAndDampingDoesNotTake) {
  const LinearDynamics dynamics(fullModel());
  const VectorXd q = VectorXd::LinSpaced(5, -0.4, 0.7);
  const VectorXd v = VectorXd::LinSpaced(5, 1.2, -0.3);
  const EvaluationPoint<double> at{1.7, 0.0, 0.0, 0.0};
  const VectorXd a = dynamics.acceleration(q, v, at);
  const Energies e = dynamics.energies(q, v, at);
  const double rate = v.dot(dynamics.linearModel().mass * a + dynamics.linearModel().stiffness * q);
  EXPECT_NEAR(rate, e.input_power - e.dissipated_power, 1e-13 * (1.0 + std::fabs(rate)));
  EXPECT_GT(e.dissipated_power, 0.0);
}

TEST(LinearDynamics, HasTheMomentumOfItsLagrangian) {
  // L = v' M v / 2 + v' G q / 2 - q' K q / 2, d/dt dL/dv - dL/dq = the forces without potential.
  const LinearDynamics dynamics(fullModel());
  const LinearModel& m = dynamics.linearModel();
  const VectorXd q = VectorXd::LinSpaced(5, 0.1, 0.9);
  const VectorXd v = VectorXd::LinSpaced(5, -2.0, 0.5);
  const EvaluationPoint<double> at{0.4, 0.0, 0.0, 0.0};
  const VectorXd a = dynamics.acceleration(q, v, at);
  const VectorXd momentum_rate = dynamics.momenta(v, a, at);  // linear in (q, v)
  const VectorXd by_q = -0.5 * m.gyroscopic * v - m.stiffness * q;
  EXPECT_TRUE((momentum_rate - by_q).isApprox(dynamics.appliedForce(q, v, at), 1e-13));
}

TEST(LinearDynamics, KeepsOnlyTheConstantForcesAtMeanLoad) {
  const LinearDynamics dynamics(fullModel());
  const Dynamics& mean = dynamics.atMeanLoad();
  const VectorXd zero = VectorXd::Zero(5);
  const HarmonicForce& constant = dynamics.linearModel().forces[0];
  for (const double time : {0.0, 0.6, 12.3}) {
    EXPECT_TRUE(mean.residualForce(zero, zero, {time, 0.0, 0.0, 0.0})
                    .isApprox(constant.amplitude * std::cos(constant.phase), 1e-15));
  }
  EXPECT_EQ(&mean.atMeanLoad(), &mean);
}

TEST(LinearDynamics, HasTheStaticDeflectionForItsNaturalLength) {
  LinearModel model = freeModel(2);
  model.stiffness.diagonal() << 100.0, 400.0;
  EXPECT_EQ(LinearDynamics(model).naturalLength(), 1.0) << "nothing deflects it";
  model.forces = {{(VectorXd(2) << 3.0, -20.0).finished(), 5.0, 0.0}};
  EXPECT_NEAR(LinearDynamics(model).naturalLength(), 0.05, 1e-15);
  // A rigid-body mode has no static deflection.
  model.stiffness << 100.0, -100.0, -100.0, 100.0;
  model.forces = {{(VectorXd(2) << 1.0, -1.0).finished(), 0.0, 0.0}};
  EXPECT_NEAR(LinearDynamics(model).naturalLength(), 0.005, 1e-15);
}

TEST(LinearDynamics, RefusesWhatIsNoSystem) {
  LinearModel model = freeModel(3);
  model.damping = MatrixXd::Zero(2, 3);
  EXPECT_THROW(LinearDynamics{model}, std::logic_error);
  model = freeModel(3);
  model.mass(1, 1) = 0.0;
  EXPECT_THROW(LinearDynamics{model}, InputError);
  model = freeModel(3);
  model.forces = {{VectorXd::Ones(2), 0.0, 0.0}};
  EXPECT_THROW(LinearDynamics{model}, std::logic_error);
}

}  // namespace linear_dynamics_test
}  // namespace whirl_twin

// The principle of virtual work on the models, and the count of degrees of freedom.
#include "analysis/virtual_work.h"

#include <gtest/gtest.h>

#include <Eigen/Dense>

#include "analysis/constraint_audit.h"
#include "models_under_test.h"

namespace whirl_twin {
namespace {

using Eigen::MatrixXd;
using Eigen::VectorXd;

VectorXd one(double value) {
  return VectorXd::Constant(1, value);
}

std::shared_ptr<const Dynamics> doublePendulum() {
  return dynamicsOf("double_pendulum",
                    {{"mass1", 1.0}, {"mass2", 0.7}, {"length1", 0.5}, {"length2", 0.8}});
}

TEST(VirtualWork, OfTheTwoBarLinkageIsThatOfTheNotes) {
  // delta W = P delta x + 2 m g delta h, x = 2 l sin(theta), h = (l / 2) cos(theta).
  const double m = 2.0;
  const double l = 1.0;
  const double force = 10.0;
  const double g = 9.81;
  const auto bars =
      dynamicsOf("two_bar_linkage", {{"bar_mass", m}, {"bar_length", l}, {"force", force}}, g);
  for (const double theta : {0.0, 0.4, 1.2}) {
    const double expected =
        force * 2.0 * l * std::cos(theta) - 2.0 * m * g * 0.5 * l * std::sin(theta);
    EXPECT_NEAR(virtualWork(*bars, one(theta), one(1e-3), {}), 1e-3 * expected, 1e-12);
  }
  // Zero where the notes say (with their slip put right): tan(theta) = 2 P / (m g).
  const double rest = std::atan(2.0 * force / (m * g));
  EXPECT_NEAR(virtualWork(*bars, one(rest), one(1.0), {}), 0.0, 1e-12);
}

TEST(VirtualWork, IsTheLossOfPotentialEnergyWhereForcesHaveOne) {
  const auto pendulum = doublePendulum();
  const VectorXd q = Eigen::Vector2d(0.7, -1.1);
  const VectorXd rest = VectorXd::Zero(2);
  const double step = 1e-6;  // central difference: third derivatives near 1e1 times step^2
  for (const VectorXd& dq :
       {VectorXd(Eigen::Vector2d(1.0, 0.0)), VectorXd(Eigen::Vector2d(-0.3, 2.0))}) {
    const auto potential = [&](double way) {
      return pendulum->energies(q + way * dq, rest, {}).potential;
    };
    EXPECT_NEAR(virtualWork(*pendulum, q, dq, {}),
                -(potential(step) - potential(-step)) / (2.0 * step), 1e-7);
  }
}

TEST(VirtualWork, RefusesAWrongSize) {
  const auto pendulum = doublePendulum();
  EXPECT_THROW(virtualWork(*pendulum, one(1.0), VectorXd::Ones(2), {}), std::invalid_argument);
  EXPECT_THROW(virtualWork(*pendulum, VectorXd::Ones(2), one(1.0), {}), std::invalid_argument);
}

/// x1^2 + y1^2 = a^2 and (x2 - x1)^2 + (y2 - y1)^2 = b^2, in x1, y1, x2, y2.
MatrixXd doublePendulumJacobian(const Eigen::Vector2d& first, const Eigen::Vector2d& second) {
  MatrixXd jacobian = MatrixXd::Zero(2, 4);
  jacobian.block(0, 0, 1, 2) = 2.0 * first.transpose();
  jacobian.block(1, 0, 1, 2) = -2.0 * (second - first).transpose();
  jacobian.block(1, 2, 1, 2) = 2.0 * (second - first).transpose();
  return jacobian;
}

TEST(Constraints, APointOnASphereHasTwoDegreesOfFreedom) {
  const MatrixXd gradient = 2.0 * Eigen::RowVector3d(0.3, -0.4, 1.2);
  const ConstraintAudit audit = auditConstraints(gradient);
  EXPECT_EQ(audit.coordinates, 3);
  EXPECT_EQ(audit.independent, 1);
  EXPECT_EQ(audit.degrees_of_freedom, 2);
  EXPECT_LT((gradient * audit.admissible).norm(), 1e-14);
  // At the centre its equation says nothing to first order.
  const ConstraintAudit centre = auditConstraints(MatrixXd::Zero(1, 3));
  EXPECT_EQ(centre.independent, 0);
  EXPECT_EQ(centre.redundant(), 1);
}

TEST(Constraints, TheDoublePendulumHasTwoDegreesOfFreedomEvenStretched) {
  const Eigen::Vector2d first(0.6, -0.8);
  for (const Eigen::Vector2d& second :
       {Eigen::Vector2d(1.6, -0.8), Eigen::Vector2d(2.0 * first), Eigen::Vector2d(0.25 * first)}) {
    const ConstraintAudit audit = auditConstraints(doublePendulumJacobian(first, second));
    EXPECT_EQ(audit.degrees_of_freedom, 2);
    EXPECT_EQ(audit.redundant(), 0);
  }
  // Folded to nothing, the second rod has no direction.
  EXPECT_EQ(auditConstraints(doublePendulumJacobian(first, first)).independent, 1);
}

TEST(Constraints, ForcesInRigidRodsDoNoVirtualWork) {
  const MatrixXd jacobian =
      doublePendulumJacobian(Eigen::Vector2d(0.6, -0.8), Eigen::Vector2d(1.1, -1.9));
  const ConstraintAudit audit = auditConstraints(jacobian);
  ASSERT_EQ(audit.admissible.cols(), 2);
  EXPECT_TRUE((audit.admissible.transpose() * audit.admissible).isIdentity(1e-14));
  const VectorXd forces = jacobian.transpose() * Eigen::Vector2d(37.0, -12.0);
  EXPECT_LT((forces.transpose() * audit.admissible).norm(), 1e-13);
}

TEST(Constraints, ARepeatedConstraintAddsNothing) {
  MatrixXd jacobian(3, 3);
  jacobian << 1.0, 2.0, 3.0, 1e6, 2e6, 3e6, 0.0, 1.0, 0.0;
  const ConstraintAudit audit = auditConstraints(jacobian);
  EXPECT_EQ(audit.constraints, 3);
  EXPECT_EQ(audit.independent, 2);
  EXPECT_EQ(audit.redundant(), 1);
  EXPECT_EQ(audit.degrees_of_freedom, 1);
}

TEST(Constraints, WithoutAnyEveryCoordinateIsFree) {
  const ConstraintAudit audit = auditConstraints(MatrixXd(0, 4));
  EXPECT_EQ(audit.degrees_of_freedom, 4);
  EXPECT_TRUE(audit.admissible.isIdentity(0.0));
  EXPECT_THROW(auditConstraints(MatrixXd(1, 0)), std::invalid_argument);
  EXPECT_THROW(auditConstraints(MatrixXd::Constant(1, 2, NAN)), std::invalid_argument);
}

}  // namespace
}  // namespace whirl_twin

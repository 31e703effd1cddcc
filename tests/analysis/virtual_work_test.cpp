// The principle of virtual work on the models (lecture notes): at rest, the work of all forces in a
// virtual displacement is that of residualForce(), and zero at an equilibrium.
#include <gtest/gtest.h>

#include <Eigen/Core>
#include <cmath>
#include <memory>

#include "models_under_test.h"

namespace whirl_twin {
namespace virtual_work_test {

using Eigen::MatrixXd;
using Eigen::VectorXd;

/// delta W [J] of all forces on a system at rest in q, for a displacement of its coordinates.
double virtualWork(const Dynamics& dynamics, const VectorXd& q, const VectorXd& displacement) {
  return dynamics.residualForce(q, VectorXd::Zero(q.size()), {}).dot(displacement);
}

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
    EXPECT_NEAR(virtualWork(*bars, one(theta), one(1e-3)), 1e-3 * expected, 1e-12);
  }
  // Zero where the notes state (with their error corrected): tan(theta) = 2 P / (m g).
  const double rest = std::atan(2.0 * force / (m * g));
  EXPECT_NEAR(virtualWork(*bars, one(rest), one(1.0)), 0.0, 1e-12);
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
    EXPECT_NEAR(virtualWork(*pendulum, q, dq), -(potential(step) - potential(-step)) / (2.0 * step),
                1e-7);
  }
}

}  // namespace virtual_work_test
}  // namespace whirl_twin

// A double pendulum with a motor at its elbow, upright, without friction, linearized: the angle of
// the upper arm from the vertical and that of the lower arm from the upper. Numbers: DFKI RIC
// Underactuated Robotics Lab, double_pendulum, design C.0, model 3.1; inertias about the joints.
#pragma once

#include <Eigen/Core>

#include "algebra/dense.h"

namespace whirl_twin {

struct Acrobot {
  Eigen::MatrixXd a, b;  ///< of (angles, rates) under the torque [N m]
};

inline Acrobot uprightAcrobot() {
  constexpr double kInertia1 = 0.02671076499939512, kInertia2 = 0.053878129629650884;  // kg m^2
  constexpr double kMass1 = 0.6416937799349799, kMass2 = 0.563935954099688;            // kg
  constexpr double kLength1 = 0.2, kCenter1 = 0.2, kCenter2 = 0.3212669909674605;      // m
  constexpr double kGravity = 9.81;
  const double coupled = kInertia2 + kMass2 * kLength1 * kCenter2;
  Eigen::Matrix2d mass, stiffness;
  mass << kInertia1 + kMass2 * kLength1 * kLength1 + 2.0 * coupled - kInertia2, coupled, coupled,
      kInertia2;
  const double lower = kGravity * kMass2 * kCenter2;
  stiffness << kGravity * (kMass1 * kCenter1 + kMass2 * kLength1) + lower, lower, lower, lower;
  Acrobot acrobot{Eigen::MatrixXd::Zero(4, 4), Eigen::MatrixXd::Zero(4, 1)};
  const Lu lu{Eigen::MatrixXd(mass)};
  acrobot.a.topRightCorner(2, 2).setIdentity();
  acrobot.a.bottomLeftCorner(2, 2) = lu.solve(stiffness);
  acrobot.b.bottomRows(2) = lu.solve(Eigen::Vector2d(0.0, 1.0));
  return acrobot;
}

}  // namespace whirl_twin

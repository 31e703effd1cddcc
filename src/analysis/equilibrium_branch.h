// An equilibrium followed over the speed of the shaft: where a rotor hangs in its bearings at each.
#pragma once

#include <Eigen/Core>
#include <vector>

#include "mechanics/dynamics.h"
#include "mechanics/linear_rotor.h"

namespace whirl_twin {

struct RestAt {
  double speed = 0.0;  ///< [rad/s]
  Eigen::VectorXd q;
};

/// The equilibrium q at `speed` [rad/s] and on from there to `end`, in strides of a ratio > 1, as
/// far as there is one; of a linear system q itself, for it is judged anywhere.
std::vector<RestAt> equilibriumBranch(const Dynamics& dynamics, const Eigen::VectorXd& q,
                                      double speed, double end, double ratio);

/// A nonlinear rotor with a shaft as the linear one that its small motion makes of it: its matrices
/// about where it hangs at each speed. Its `dof` is 0 where no equilibrium was found. Nothing is
/// told of what turns with its shaft.
struct SmallMotionRotor {
  LinearRotor rotor;
  double lowest = 0.0;   ///< [rad/s], of the speeds that it was followed over
  double highest = 0.0;  ///< [rad/s]
};
SmallMotionRotor smallMotionRotor(const Dynamics& dynamics);

}  // namespace whirl_twin

// Continuation of an equilibrium over the speed of the shaft: the static position of a rotor in its
// bearings.
#pragma once

#include <Eigen/Core>
#include <vector>

#include "mechanics/dynamics.h"
#include "mechanics/linear_rotor.h"

namespace whirl_twin {

struct EquilibriumAt {
  double speed = 0.0;  ///< [rad/s]
  Eigen::VectorXd q;
};

/// The equilibrium q at `speed` [rad/s] and its continuation to `end`, in steps of a ratio > 1, as
/// far as it exists; for a linear system q itself, as its stability does not depend on q.
std::vector<EquilibriumAt> equilibriumBranch(const Dynamics& dynamics, const Eigen::VectorXd& q,
                                             double speed, double end, double ratio);

/// Linearization of a nonlinear rotor: its matrices about its equilibrium at each speed. Its `dof`
/// is 0 where no equilibrium was found. Synchronous forces are not included.
struct LinearizedMotionRotor {
  LinearRotor rotor;
  double lowest = 0.0;   ///< [rad/s], of the speeds that it was followed over
  double highest = 0.0;  ///< [rad/s]
};
LinearizedMotionRotor linearizedMotionRotor(const Dynamics& dynamics);

}  // namespace whirl_twin

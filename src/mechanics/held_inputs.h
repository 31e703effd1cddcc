// Effect of zero-order-hold inputs: their force, and its derivatives by the inputs and the
// coordinates.
#pragma once

#include <Eigen/Core>

#include "mechanics/dynamics.h"

namespace whirl_twin {

struct HeldInputs {
  Eigen::VectorXd force;      ///< generalized [n]
  Eigen::MatrixXd by_input;   ///< d force / d inputs [n x inputs]
  Eigen::MatrixXd stiffness;  ///< -d force / d q [n x n], beside that without inputs
};

/// Inputs in their units, in the order of dynamics.inputs(), at q. What a force has no place for
/// is no number.
HeldInputs heldInputs(const Dynamics& dynamics, const Eigen::VectorXd& q,
                      const Eigen::VectorXd& inputs);

}  // namespace whirl_twin

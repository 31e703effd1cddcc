// A linear system in samples.
#pragma once

#include <Eigen/Core>

namespace whirl_twin {

/// x(k+1) = a x(k) + b y(k), u(k) = c x(k) + d y(k): of a controller, y what it measures and u its
/// outputs. Without a state a is 0 x 0.
struct DiscreteStateSpace {
  Eigen::MatrixXd a;  ///< [n x n]
  Eigen::MatrixXd b;  ///< [n x measured]
  Eigen::MatrixXd c;  ///< [outputs x n]
  Eigen::MatrixXd d;  ///< [outputs x measured]

  Eigen::Index states() const { return a.rows(); }
};

}  // namespace whirl_twin

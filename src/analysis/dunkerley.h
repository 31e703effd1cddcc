// Dunkerley's formula (lecture notes): the trace of the dynamical matrix [D] = [a][m] is the sum of
// all 1 / p_i^2, so that
//   1 / p_1^2 < tr [D] = sum of D_ii,   for a diagonal [m]  sum of a_ii m_i = sum of 1 / p_ii^2,
// p_ii with m_i as the only mass: a lower bound of the lowest natural frequency (equal to it with
// one coordinate).
#pragma once

#include <Eigen/Core>

namespace whirl_twin {

struct DunkerleyBound {
  double frequency = 0.0;  ///< [rad/s], p_1 is not below it
  Eigen::VectorXd terms;   ///< [s^2], D_ii; of a diagonal mass 1 / p_ii^2 [n]
};

/// Throws RunFailure, with the reason, for a stiffness without influence coefficients
/// (singular: p_1 = 0 has no lower bound above it), Refusal as naturalModes().
DunkerleyBound dunkerleyBound(const Eigen::MatrixXd& mass, const Eigen::MatrixXd& stiffness);

}  // namespace whirl_twin

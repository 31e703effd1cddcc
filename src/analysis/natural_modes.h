// Natural frequencies and mode shapes of an undamped system, [m] q'' + [k] q = 0:
//   ([k] - p_i^2 [m]) phi_i = 0,   phi_i^T [m] phi_j = 1 for i = j, else 0.
//
// The frequencies are the singular values of L_m^-1 L_k, the Cholesky factors of both matrices: p^2
// is never formed, so that no rounding makes it negative and low modes keep their digits beside
// high ones. Rigid-body modes are taken out first, as the motions the stiffness does not resist,
// and have p = 0 exactly.
#pragma once

#include <Eigen/Core>

namespace whirl_twin {

struct NaturalModes {
  Eigen::VectorXd frequencies;  ///< p [rad/s], ascending; zero for rigid-body modes [n]
  Eigen::MatrixXd shapes;       ///< columns, mass-normalised [n x n]
  int rigid_body_modes = 0;     ///< how many of the frequencies are zero
};

/// Throws Refusal if the mass is not positive definite or a matrix not symmetric, and
/// RunFailure if the stiffness is negative for some motion: then p is imaginary. Which
/// motions count as rigid-body modes: rigidBodyModes().
NaturalModes naturalModes(const Eigen::MatrixXd& mass, const Eigen::MatrixXd& stiffness);

/// Throws Refusal unless both are of the same size.
void requireSameSize(const Eigen::MatrixXd& mass, const Eigen::MatrixXd& stiffness);

}  // namespace whirl_twin

// Degrees of freedom (lecture notes, "constraints and coordinates"): coordinates less independent
// constraints. Constraints g_j(x, t) = c admit the virtual displacements with [dg_j / dx_i]{delta
// x} = 0; their forces, along the gradients, do no work in them.
#pragma once

#include <Eigen/Core>

namespace whirl_twin {

struct ConstraintAudit {
  int coordinates = 0;
  int constraints = 0;
  int independent = 0;         ///< rank of the Jacobian
  int degrees_of_freedom = 0;  ///< coordinates - independent
  Eigen::MatrixXd admissible;  ///< orthonormal basis of the virtual displacements [n x dof]

  /// Constraints that say nothing new to first order: repeated, or singular in this position (the
  /// gradient of a sphere's equation vanishes at its centre).
  int redundant() const { return constraints - independent; }
};

/// Of the Jacobian dg_j / dx_i of the constraints at one position [m x n], n > 0. A constraint
/// counts as independent if, with all gradients scaled to length 1, it adds more than 1e-10 to the
/// others. Throws std::invalid_argument for a Jacobian without columns or with an entry that is not
/// finite.
ConstraintAudit auditConstraints(const Eigen::MatrixXd& jacobian);

}  // namespace whirl_twin

// Rigid-body modes (lecture notes, "for example a submarine"): motions q that a semidefinite
// stiffness does not resist, [k] q = 0, the modes of zero natural frequency.
#pragma once

#include <Eigen/Core>

#include "analysis/quadratic_form.h"

namespace whirl_twin {

/// An orthonormal basis of the motions that the stiffness does not resist [n x r], r = 0 for a
/// definite one. A motion counts as free if the stiffness, scaled to unit diagonal, resists it by
/// less than kZeroEigenvalue. Throws Refusal for a matrix that is not symmetric,
/// RunFailure for one that is negative for some motion (a statically unstable position).
Eigen::MatrixXd rigidBodyModes(const Eigen::MatrixXd& stiffness);

}  // namespace whirl_twin

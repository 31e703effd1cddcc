// Influence coefficients (lecture notes, "stiffness and flexibility"): a_ij is the deflection of
// coordinate i under a unit force on coordinate j, {delta} = [a]{F}, [a] = [k]^-1.
#pragma once

#include <Eigen/Core>

namespace whirl_twin {

/// [a] of a stiffness [n x n], in the inverse of its units (m/N between lengths), symmetric.
/// Throws RunFailure, with the reason in words, for a stiffness that carries no load at
/// rest: one with rigid-body modes, or negative for some motion; Refusal for one that
/// is not symmetric.
Eigen::MatrixXd influenceCoefficients(const Eigen::MatrixXd& stiffness);

}  // namespace whirl_twin

// Eigenvalues of a system whose matrix entries differ by orders of magnitude: supports of 1e20 N/m
// and a shaft of 1e6 N/m, nodes of 1e-6 kg and a disc of 10 kg. The norm of the state matrix is
// that of the largest eigenvalues, and its rounding errors exceed the lowest. With K = L L^T, M = R
// R^T and the state (y, z) = (L^T q, s R^T q) the inverse problem
//
//   [ -(I + N')^-1 C'   -(I + N')^-1 F ] [y]         [y]     C' = L^-1 (C + G) L^-T,
//   [  F^T                0            ] [z] = (1/s) [z],    N' = L^-1 N L^-T,  F = L^-1 R,
//
// has the lowest frequencies as its largest eigenvalues, and stiff or light parts as nearly zero
// ones. The scalar product of its states is that of the energy: without damping and circulatory
// forces it is skew. Neither factor mixes large with small: their errors are those of the matrices
// scaled to unit diagonals (J. Demmel, K. Veselic, SIAM J. Matrix Anal. Appl. 13, 1992).
#pragma once

#include <Eigen/Core>
#include <optional>

#include "mechanics/linearization.h"

namespace whirl_twin {

struct FlexibilityPairs {
  Eigen::VectorXcd values;  ///< s [1/s]; those that are infinite to rounding are left out
  Eigen::MatrixXcd shapes;  ///< q, in columns, of energy 1
  double error = 0.0;       ///< [s], of 1/s by rounding: an s is off by about error |s|^2
};

/// Nothing of a stiffness that is not positive definite, of one that the circulatory forces all but
/// cancel, and where the eigenvalues do not converge. Without damping and circulatory forces the
/// values are imaginary, exactly.
std::optional<FlexibilityPairs> flexibilityPairs(const Linearization& linearization);

/// R [n x r] with M = R R^T of a positive semidefinite M whose zero rows, if any, are those of
/// coordinates without inertia: r coordinates have some. Empty (r = 0) of another.
Eigen::MatrixXd inertiaFactor(const Eigen::MatrixXd& mass);

}  // namespace whirl_twin

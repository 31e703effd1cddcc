// Balancing of a matrix.
#pragma once

#include <Eigen/Core>

namespace whirl_twin {

/// D^-1 a D with a diagonal D of powers of two that brings rows and columns near one another in
/// size (B. Parlett, C. Reinsch, Numer. Math. 13 (1969) 293): the same eigenvalues, no rounding,
/// and statements on its norm do not depend on the units of its states. `a` is square.
Eigen::MatrixXd balanced(const Eigen::MatrixXd& a);

/// The diagonal of D.
Eigen::VectorXd balancingUnits(Eigen::MatrixXd a);

}  // namespace whirl_twin

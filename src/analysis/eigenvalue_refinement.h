// How far the eigenvalues of a reduced rotor are from those of the full one, without all of those.
#pragma once

#include <Eigen/Core>

#include "mechanics/linearization.h"

namespace whirl_twin {

/// Largest |s_full - s_reduced| / |s_full| over the eigenvalues with |s| <= largest [1/s] of the
/// rotor reduced to `shapes` [dof x n]. Each is followed to its own of the full rotor by Newton's
/// method on (s^2 M + s (C + G) + K + N) v = 0, c^H v = 1.
double largestEigenvalueError(const Linearization& full, const Linearization& reduced,
                              const Eigen::MatrixXd& shapes, double largest);

}  // namespace whirl_twin

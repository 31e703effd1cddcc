// Modal damping, as identified in a test, that does not rotate with the shaft.
//
// With the modes Phi of the rotor at rest on its bearings, undamped, Phi^T M Phi = 1 and Phi^T K
// Phi = diag(w^2), C = M Phi diag(2 zeta w) Phi^T M gives each mode the ratio zeta(w) and couples
// none (Clough and Penzien, Dynamics of Structures, 1993). Rigid-body motions without stiffness are
// undamped.
#pragma once

#include <Eigen/Core>
#include <vector>

namespace whirl_twin {

/// Between two frequencies the ratio is linear, outside it is that of the first or the last.
struct DampingRatio {
  double frequency = 0.0;  ///< [rad/s], ascending
  double ratio = 0.0;      ///< [-]
};

double ratioAt(const std::vector<DampingRatio>& ratios, double frequency);

/// C [N s/m, N s, N m s] of every mode; none where the mass is not positive or nothing is finite.
Eigen::MatrixXd modalDamping(const Eigen::MatrixXd& mass, const Eigen::MatrixXd& stiffness,
                             const std::vector<DampingRatio>& ratios);

}  // namespace whirl_twin

// Rayleigh's quotient of an assumed shape {phi} (lecture notes, assumed modes method with one
// mode, "use static deflection as mode"):
//   p^2 = {phi}^T [k] {phi} / {phi}^T [m] {phi}  >=  p_1^2,
// an upper bound of the lowest natural frequency, and close to it: an error of the shape enters
// squared.
#pragma once

#include <Eigen/Core>

namespace whirl_twin {

/// p [rad/s] from a shape [n] that is not zero. Throws Refusal for a zero shape, one
/// of the wrong size, or a mass that is not positive definite, and RunFailure if the
/// stiffness is negative for the shape (p is then imaginary).
double rayleighFrequency(const Eigen::MatrixXd& mass, const Eigen::MatrixXd& stiffness,
                         const Eigen::VectorXd& shape);

/// The deflection [n] under a load at rest, [k]{delta} = {load}. Errors as influenceCoefficients().
Eigen::VectorXd staticDeflection(const Eigen::MatrixXd& stiffness, const Eigen::VectorXd& load);

/// The load of the system's own weight, [m]{down} g, in N for a length. `down` [n]: how the
/// coordinates change as everything moves down by one unit; `gravity` [m/s^2].
Eigen::VectorXd weight(const Eigen::MatrixXd& mass, const Eigen::VectorXd& down, double gravity);

}  // namespace whirl_twin

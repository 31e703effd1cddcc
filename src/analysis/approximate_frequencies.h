// Dunkerley's formula (lecture notes): the trace of the dynamical matrix [D] = [a][m] is the sum of
// all 1 / p_i^2, so that
//   1 / p_1^2 < tr [D] = sum of D_ii,   for a diagonal [m]  sum of a_ii m_i = sum of 1 / p_ii^2,
// p_ii with m_i as the only mass: a lower bound of the lowest natural frequency (equal to it with
// one coordinate).
#pragma once

#include <Eigen/Core>
#include <vector>

namespace whirl_twin {

struct DunkerleyBound {
  double frequency = 0.0;  ///< [rad/s], p_1 is not below it
  Eigen::VectorXd terms;   ///< [s^2], D_ii; of a diagonal mass 1 / p_ii^2 [n]
};

/// Throws RunFailure, with the reason, for a stiffness without influence coefficients
/// (singular: p_1 = 0 has no lower bound above it), InputError as naturalModes().
DunkerleyBound dunkerleyBound(const Eigen::MatrixXd& mass, const Eigen::MatrixXd& stiffness);

// Rayleigh's quotient of an assumed shape {phi} (lecture notes, assumed modes method with one
// mode, "use static deflection as mode"):
//   p^2 = {phi}^T [k] {phi} / {phi}^T [m] {phi}  >=  p_1^2,
// an upper bound of the lowest natural frequency, and close to it: an error of the shape enters
// squared.

/// p [rad/s] from a shape [n] that is not zero. Throws InputError for a zero shape, one
/// of the wrong size, or a mass that is not positive definite, and RunFailure if the
/// stiffness is negative for the shape (p is then imaginary).
double rayleighFrequency(const Eigen::MatrixXd& mass, const Eigen::MatrixXd& stiffness,
                         const Eigen::VectorXd& shape);

/// The deflection [n] under a load at rest, [k]{delta} = {load}. Errors as influenceCoefficients().
Eigen::VectorXd staticDeflection(const Eigen::MatrixXd& stiffness, const Eigen::VectorXd& load);

/// The load of the system's own weight, [m]{down} g, in N for a length. `down` [n]: how the
/// coordinates change as everything moves down by one unit; `gravity` [m/s^2].
Eigen::VectorXd weight(const Eigen::MatrixXd& mass, const Eigen::VectorXd& down, double gravity);

// Matrix iteration (lecture notes, dynamical matrix): [D] = [a][m] applied again and again turns
// any shape into the mode with the largest 1 / p^2, the lowest; each step reduces the share of the
// others by (p_1 / p_i)^2. Sweeping the known modes out of the shape, phi_i^T [m] x = 0, leads to
// the next one. For equal roots it finds as many independent shapes, each of them a mode.

struct IterationLimits {
  double tolerance = 1e-9;  ///< [-], |D x - x / p^2| / (|x| / p^2): 1 / p^2 of a mode is as near
  int most_steps = 10000;   ///< for one mode
};

struct IteratedMode {
  double frequency = 0.0;  ///< p [rad/s], Rayleigh's quotient of the shape: above the exact one
  Eigen::VectorXd shape;   ///< mass-normalised [n]
  bool converged = false;  ///< false: limits.most_steps were not enough
  std::vector<double> history;  ///< p [rad/s] after each step; its size is the number of steps
};

/// The `count` lowest modes, 1 to n, by rising frequency, the first from the shape `start` [n]. A
/// start without any part of a mode would never come to it: a shape that has converged is disturbed
/// once, and has to converge again. Ends with a mode that does not converge.
/// Throws RunFailure for a stiffness without influence coefficients, InputError
/// for a zero start, a wrong size or count, or a mass that is not positive definite.
std::vector<IteratedMode> matrixIteration(const Eigen::MatrixXd& mass,
                                          const Eigen::MatrixXd& stiffness, int count,
                                          const Eigen::VectorXd& start,
                                          const IterationLimits& limits = {});

}  // namespace whirl_twin

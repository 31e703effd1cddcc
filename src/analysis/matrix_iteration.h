// Matrix iteration (lecture notes, dynamical matrix): [D] = [a][m] applied again and again turns
// any shape into the mode with the largest 1 / p^2, the lowest; each step shrinks what is left of
// the others by (p_1 / p_i)^2. Sweeping the modes found out of the shape, phi_i^T [m] x = 0, leads
// to the next one. Of equal roots it finds as many independent shapes, each of them a mode.
#pragma once

#include <Eigen/Core>
#include <vector>

namespace whirl_twin {

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
/// Throws RunFailure for a stiffness without influence coefficients, Refusal
/// for a zero start, a wrong size or count, or a mass that is not positive definite.
std::vector<IteratedMode> matrixIteration(const Eigen::MatrixXd& mass,
                                          const Eigen::MatrixXd& stiffness, int count,
                                          const Eigen::VectorXd& start,
                                          const IterationLimits& limits = {});

}  // namespace whirl_twin

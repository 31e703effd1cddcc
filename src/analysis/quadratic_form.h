// Quadratic forms (lecture notes, "stiffness and flexibility"): V = 1/2 q^T [k] q and
// T = 1/2 q'^T [m] q'. Positive definite: zero only at rest. Positive semidefinite: never negative,
// but zero for a motion that is not zero; of a stiffness, a rigid-body mode.
#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <string>

namespace whirl_twin {

enum class Definiteness : std::uint8_t { kPositiveDefinite, kPositiveSemidefinite, kIndefinite };

/// An eigenvalue of a form scaled to unit diagonal counts as zero below this: the scaling makes the
/// answer independent of the units of the coordinates, and the entries are assumed accurate to 12
/// digits.
constexpr double kZeroEigenvalue = 1e-12;

/// Of a symmetric matrix [n x n]. Throws InputError if it is not square, symmetric (to
/// 1e-9 of its largest entry) and finite; `name`, such as "stiffness", is for the message.
Definiteness definiteness(const Eigen::MatrixXd& form, const std::string& name);

/// Throws InputError, saying why, unless the form is positive definite.
void requirePositiveDefinite(const Eigen::MatrixXd& form, const std::string& name);

/// Throws InputError unless it is square, symmetric and finite, as definiteness().
void requireSymmetric(const Eigen::MatrixXd& form, const std::string& name);

/// The form with its coordinates scaled to make the diagonal 1 (or -1; a zero stays zero).
struct ScaledForm {
  Eigen::MatrixXd form;   ///< [n x n], S form S
  Eigen::VectorXd scale;  ///< [n], the diagonal of S
};
ScaledForm unitDiagonal(const Eigen::MatrixXd& form);

}  // namespace whirl_twin

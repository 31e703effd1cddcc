// The characteristic polynomial of M q'' + (C + G) q' + (K + N) q = 0, or of a matrix, exact for
// the matrices given.
//
// Doubles are rational numbers, so det(M s^2 + (C + G) s + K + N) can be computed without any
// rounding. This preserves structure: an undamped system has odd coefficients that are zero, not
// 1e-17, and Routh's test returns marginal where it is marginal.
#pragma once

#include <Eigen/Core>
#include <vector>

#include "analysis/exact_number.h"
#include "mechanics/dynamics.h"

namespace whirl_twin {

// Determinants of matrices of doubles as polynomials, without any rounding: doubles are rational
// numbers, and times a power of two whole ones.

/// A matrix that is the sum of two, or one.
struct MatrixSum {
  MatrixSum(const Eigen::MatrixXd& one)
      : first(one), second(Eigen::MatrixXd::Zero(one.rows(), one.cols())) {}
  MatrixSum(const Eigen::MatrixXd& one, const Eigen::MatrixXd& other) : first(one), second(other) {}
  Eigen::MatrixXd first, second;
};

/// det(parts[0] s^d + ... + parts[d]) times a positive number, highest power first, n d + 1
/// coefficients of which the first may be 0; all parts [n x n]. Its values at n d + 1 whole
/// numbers, by elimination without fractions (Bareiss, Mathematics of Computation 22, 1968), give
/// it by Newton's divided differences. Throws ExactBudgetSpent; std::overflow_error where an entry
/// is not finite.
std::vector<Rational> determinantPolynomial(const std::vector<MatrixSum>& parts,
                                            ExactBudget& budget);

/// Monic, highest power first, degree 2 dof. The cost grows fast: meant for a few coordinates.
/// Throws InputError if the mass matrix is singular.
std::vector<Rational> characteristicPolynomial(const Linearization& linearization);

/// det(s I - a) times a positive number, highest power first; [n x n], finite. Throws
/// ExactBudgetSpent.
std::vector<Rational> characteristicPolynomial(const Eigen::MatrixXd& a, ExactBudget& budget);

/// The minimal polynomial of the state matrix: a repeated root of the characteristic polynomial is
/// simple here where the matrix has a full set of eigenvectors for it (an isotropic rotor in x, y).
std::vector<Rational> minimalPolynomial(const Linearization& linearization);
/// That of a matrix.
std::vector<Rational> minimalPolynomial(const Eigen::MatrixXd& a);

}  // namespace whirl_twin

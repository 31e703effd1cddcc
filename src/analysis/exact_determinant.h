// Determinants of matrices of doubles as polynomials, without any rounding: doubles are rational
// numbers, and times a power of two whole ones.
#pragma once

#include <Eigen/Core>
#include <vector>

#include "analysis/exact_number.h"

namespace whirl_twin {

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

}  // namespace whirl_twin

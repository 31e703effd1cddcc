// Hurwitz determinants, as an independent check of Routh's table.
#pragma once

#include <algorithm>
#include <utility>
#include <vector>

#include "analysis/exact_number.h"

namespace whirl_twin {

inline Rational determinant(std::vector<std::vector<Rational>> matrix) {
  Rational product = 1;
  for (std::size_t column = 0; column < matrix.size(); ++column) {
    const auto pivot_row = std::find_if(matrix.begin() + column, matrix.end(),
                                        [&](const auto& row) { return row[column] != 0; });
    if (pivot_row == matrix.end()) {
      return 0;
    }
    if (pivot_row != matrix.begin() + column) {
      std::swap(*pivot_row, matrix[column]);
      product = -product;
    }
    product *= matrix[column][column];
    for (std::size_t row = column + 1; row < matrix.size(); ++row) {
      const Rational factor = matrix[row][column] / matrix[column][column];
      for (std::size_t j = column; j < matrix.size(); ++j) {
        matrix[row][j] -= factor * matrix[column][j];
      }
    }
  }
  return product;
}

/// Hurwitz determinants D_1 ... D_n of a_0 s^n + ... + a_n: leading principal minors of the matrix
/// H[i][j] = a_{2j-i}, i, j = 1 ... n. With a_0 > 0 all roots lie left if and only if all are
/// positive (Hurwitz 1895). Leading zeros are dropped.
inline std::vector<Rational> hurwitzMinors(const std::vector<Rational>& coefficients) {
  const std::vector<Rational> polynomial(
      std::find_if(coefficients.begin(), coefficients.end(),
                   [](const Rational& coefficient) { return coefficient != 0; }),
      coefficients.end());
  const int degree = static_cast<int>(polynomial.size()) - 1;
  std::vector<Rational> minors;
  for (int size = 1; size <= degree; ++size) {
    std::vector<std::vector<Rational>> matrix(size, std::vector<Rational>(size));
    for (int i = 0; i < size; ++i) {
      for (int j = 0; j < size; ++j) {
        const int index = 2 * (j + 1) - (i + 1);
        if (index >= 0 && index <= degree) {
          matrix[i][j] = polynomial[index];
        }
      }
    }
    minors.push_back(determinant(std::move(matrix)));
  }
  return minors;
}

}  // namespace whirl_twin

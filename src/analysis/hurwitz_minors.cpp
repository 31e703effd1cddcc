#include <algorithm>
#include <stdexcept>
#include <utility>

#include "analysis/routh.h"

namespace whirl_twin {

namespace {

using Matrix = std::vector<std::vector<Rational>>;

Rational determinant(Matrix matrix) {
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

}  // namespace

std::vector<Rational> hurwitzMinors(const std::vector<Rational>& coefficients) {
  const std::vector<Rational> polynomial(
      std::find_if(coefficients.begin(), coefficients.end(),
                   [](const Rational& coefficient) { return coefficient != 0; }),
      coefficients.end());
  if (polynomial.empty()) {
    throw std::invalid_argument(
        "polynomial: expected at least one coefficient that is not zero, found none");
  }
  const int degree = static_cast<int>(polynomial.size()) - 1;
  std::vector<Rational> minors;
  for (int size = 1; size <= degree; ++size) {
    Matrix matrix(size, std::vector<Rational>(size));
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

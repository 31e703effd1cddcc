#include "analysis/exact_determinant.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>
#include <stdexcept>
#include <utility>

namespace whirl_twin {

namespace {

using IntegerMatrix = std::vector<std::vector<Integer>>;

/// The number times 2^-exponent, which makes it whole.
Integer whole(double x, int exponent) {
  int own = 0;
  const auto mantissa = static_cast<std::int64_t>(std::ldexp(std::frexp(x, &own), 53));
  return mantissa == 0 ? Integer(0) : Integer(mantissa) << (own - 53 - exponent);
}

/// The lowest exponent of the last bits of a row.
int lowestExponent(const std::vector<MatrixSum>& sums, Eigen::Index row) {
  int lowest = std::numeric_limits<int>::max();
  for (const MatrixSum& sum : sums) {
    for (const Eigen::MatrixXd* m : {&sum.first, &sum.second}) {
      for (const double x : m->row(row)) {
        if (!std::isfinite(x)) {
          throw std::overflow_error("a matrix entry is not finite");
        }
        int exponent = 0;
        if (std::frexp(x, &exponent) != 0.0) {
          lowest = std::min(lowest, exponent - 53);
        }
      }
    }
  }
  return lowest;
}

/// Each row times the same power of two in all of them, which makes its entries whole.
std::vector<IntegerMatrix> integers(const std::vector<MatrixSum>& sums) {
  std::vector<IntegerMatrix> result(sums.size());
  const Eigen::Index n = sums.front().first.rows();
  for (Eigen::Index i = 0; i < n; ++i) {
    const int lowest = lowestExponent(sums, i);
    for (std::size_t k = 0; k < sums.size(); ++k) {
      const auto& [first, second] = sums[k];
      result[k].emplace_back();
      for (Eigen::Index j = 0; j < n; ++j) {
        result[k].back().push_back(whole(first(i, j), lowest) + whole(second(i, j), lowest));
      }
    }
  }
  return result;
}

IntegerMatrix atValue(const std::vector<IntegerMatrix>& parts, int s) {
  IntegerMatrix sum = parts.front();
  for (std::size_t part = 1; part < parts.size(); ++part) {
    for (std::size_t i = 0; i < sum.size(); ++i) {
      for (std::size_t j = 0; j < sum.size(); ++j) {
        sum[i][j] = s * sum[i][j] + parts[part][i][j];
      }
    }
  }
  return sum;
}

Integer determinant(IntegerMatrix m, ExactBudget& budget) {
  Integer before = 1;
  bool negative = false;
  for (std::size_t k = 0; k + 1 < m.size(); ++k) {
    std::size_t pivot = k;
    while (pivot < m.size() && m[pivot][k] == 0) {
      ++pivot;
    }
    if (pivot == m.size()) {
      return 0;
    }
    if (pivot != k) {
      std::swap(m[pivot], m[k]);
      negative = !negative;
    }
    for (std::size_t i = k + 1; i < m.size(); ++i) {
      for (std::size_t j = k + 1; j < m.size(); ++j) {
        m[i][j] = m[i][j] * m[k][k] - m[i][k] * m[k][j];
        budget.spendOn(m[i][j]);
        m[i][j] /= before;
      }
    }
    before = m[k][k];
  }
  const Integer last = m.empty() ? Integer(1) : m.back().back();
  return negative ? Integer(-last) : last;
}

}  // namespace

std::vector<Rational> determinantPolynomial(const std::vector<MatrixSum>& parts,
                                            ExactBudget& budget) {
  const std::vector<IntegerMatrix> whole_parts = integers(parts);
  const int degree = static_cast<int>(whole_parts.front().size() * (parts.size() - 1));
  const int first = -(degree / 2);
  std::vector<Integer> differences;
  for (int i = 0; i <= degree; ++i) {
    differences.push_back(determinant(atValue(whole_parts, first + i), budget));
  }
  // Of a polynomial with whole coefficients at whole numbers they are whole, too.
  const std::size_t count = differences.size();
  for (std::size_t level = 1; level < count; ++level) {
    for (std::size_t i = count - 1; i >= level; --i) {
      differences[i] = (differences[i] - differences[i - 1]) / static_cast<int>(level);
    }
  }
  std::vector<Integer> polynomial;  // lowest power first
  for (std::size_t i = count; i-- > 0;) {
    const int node = static_cast<int>(i) + first;
    polynomial.insert(polynomial.begin(), Integer(0));  // times (s - node)
    for (std::size_t k = 0; k + 1 < polynomial.size(); ++k) {
      polynomial[k] -= node * polynomial[k + 1];
    }
    polynomial[0] += differences[i];
  }
  return {polynomial.rbegin(), polynomial.rend()};
}

}  // namespace whirl_twin

#include "analysis/characteristic_polynomial.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>
#include <stdexcept>
#include <utility>

#include "messages/input_error.h"

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

namespace {

using RationalRow = std::vector<Rational>;
using RationalMatrix = std::vector<RationalRow>;

RationalMatrix matrixProduct(const RationalMatrix& a, const RationalMatrix& b) {
  RationalMatrix c(a.size(), RationalRow(b.front().size()));
  for (std::size_t i = 0; i < a.size(); ++i) {
    for (std::size_t k = 0; k < b.size(); ++k) {
      if (a[i][k] == 0) {
        continue;
      }
      for (std::size_t j = 0; j < c[i].size(); ++j) {
        c[i][j] += a[i][k] * b[k][j];
      }
    }
  }
  return c;
}

/// X with M X = B, by Gauss-Jordan elimination.
RationalMatrix solveExactly(RationalMatrix m, RationalMatrix b) {
  for (std::size_t i = 0; i < m.size(); ++i) {
    std::size_t pivot = i;
    while (pivot < m.size() && m[pivot][i] == 0) {
      ++pivot;
    }
    if (pivot == m.size()) {
      throw InputError("the mass matrix is singular");
    }
    std::swap(m[i], m[pivot]);
    std::swap(b[i], b[pivot]);
    for (std::size_t r = 0; r < m.size(); ++r) {
      if (r == i || m[r][i] == 0) {
        continue;
      }
      const Rational ratio = m[r][i] / m[i][i];
      for (std::size_t c = i; c < m.size(); ++c) {
        m[r][c] -= ratio * m[i][c];
      }
      for (std::size_t c = 0; c < b[r].size(); ++c) {
        b[r][c] -= ratio * b[i][c];
      }
    }
  }
  for (std::size_t i = 0; i < m.size(); ++i) {
    for (Rational& entry : b[i]) {
      entry /= m[i][i];
    }
  }
  return b;
}

/// The state matrix [0 I; -M^-1 (K + N), -M^-1 (C + G)].
RationalMatrix rationalStateMatrix(const Linearization& l) {
  const auto n = static_cast<std::size_t>(l.mass.rows());
  RationalMatrix mass(n, RationalRow(n));
  RationalMatrix right(n, RationalRow(2 * n));
  for (std::size_t i = 0; i < n; ++i) {
    for (std::size_t j = 0; j < n; ++j) {
      const auto r = static_cast<Eigen::Index>(i);
      const auto c = static_cast<Eigen::Index>(j);
      mass[i][j] = Rational(l.mass(r, c));
      right[i][j] = -(Rational(l.stiffness(r, c)) + Rational(l.circulatory(r, c)));
      right[i][n + j] = -(Rational(l.damping(r, c)) + Rational(l.gyroscopic(r, c)));
    }
  }
  const RationalMatrix accelerations = solveExactly(mass, right);
  RationalMatrix a(2 * n, RationalRow(2 * n));
  for (std::size_t i = 0; i < n; ++i) {
    a[i][n + i] = 1;
    a[n + i] = accelerations[i];
  }
  return a;
}

/// Of a square matrix, highest power first.
std::vector<Rational> minimal(const RationalMatrix& a) {
  const std::size_t size = a.size();
  // The smallest power A^k b that depends on the lower ones; b has no symmetry that could hide a
  // direction.
  RationalMatrix vector(size, RationalRow(1));
  for (std::size_t i = 0; i < size; ++i) {
    vector[i][0] = Rational(static_cast<long>((7919 * (i + 1) * (i + 1) + 104729) % 65537));
  }
  RationalMatrix rows;          // reduced Krylov vectors ...
  RationalMatrix combinations;  // ... as combinations of b, A b, A^2 b, ...
  std::vector<std::size_t> pivots;
  for (std::size_t k = 0; k <= size; ++k) {
    RationalRow row(size);
    for (std::size_t i = 0; i < size; ++i) {
      row[i] = vector[i][0];
    }
    RationalRow combination(size + 1);
    combination[k] = 1;
    for (std::size_t r = 0; r < rows.size(); ++r) {
      const Rational ratio = row[pivots[r]] / rows[r][pivots[r]];
      if (ratio == 0) {
        continue;
      }
      for (std::size_t i = 0; i < size; ++i) {
        row[i] -= ratio * rows[r][i];
      }
      for (std::size_t i = 0; i <= size; ++i) {
        combination[i] -= ratio * combinations[r][i];
      }
    }
    std::size_t pivot = 0;
    while (pivot < size && row[pivot] == 0) {
      ++pivot;
    }
    if (pivot == size) {
      std::vector<Rational> highest_first;
      for (std::size_t i = k + 1; i-- > 0;) {
        highest_first.push_back(combination[i]);
      }
      return highest_first;
    }
    pivots.push_back(pivot);
    rows.push_back(row);
    combinations.push_back(combination);
    vector = matrixProduct(a, vector);
  }
  throw std::logic_error("a matrix satisfies its characteristic polynomial");
}

}  // namespace

std::vector<Rational> characteristicPolynomial(const Linearization& l) {
  ExactBudget unlimited(std::numeric_limits<double>::infinity());
  std::vector<Rational> polynomial = determinantPolynomial(
      {{l.mass}, {l.damping, l.gyroscopic}, {l.stiffness, l.circulatory}}, unlimited);
  const Rational leading = polynomial.front();
  if (leading == 0) {
    throw InputError("the mass matrix is singular");
  }
  for (Rational& coefficient : polynomial) {
    coefficient /= leading;
  }
  return polynomial;
}

std::vector<Rational> characteristicPolynomial(const Eigen::MatrixXd& a, ExactBudget& budget) {
  const Eigen::MatrixXd identity = Eigen::MatrixXd::Identity(a.rows(), a.cols());
  return determinantPolynomial({{identity}, {-a}}, budget);
}

std::vector<Rational> minimalPolynomial(const Linearization& linearization) {
  return minimal(rationalStateMatrix(linearization));
}

std::vector<Rational> minimalPolynomial(const Eigen::MatrixXd& a) {
  RationalMatrix exact;
  for (Eigen::Index i = 0; i < a.rows(); ++i) {
    exact.emplace_back(a.row(i).begin(), a.row(i).end());
  }
  return minimal(exact);
}

}  // namespace whirl_twin

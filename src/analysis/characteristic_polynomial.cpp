#include "analysis/characteristic_polynomial.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <limits>
#include <stdexcept>
#include <utility>

#include "messages/refusal.h"

namespace whirl_twin {

namespace {

using Row = std::vector<Rational>;
using Matrix = std::vector<Row>;

Matrix product(const Matrix& a, const Matrix& b) {
  Matrix c(a.size(), Row(b.front().size()));
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
Matrix solve(Matrix m, Matrix b) {
  for (std::size_t i = 0; i < m.size(); ++i) {
    std::size_t pivot = i;
    while (pivot < m.size() && m[pivot][i] == 0) {
      ++pivot;
    }
    if (pivot == m.size()) {
      throw Refusal("the mass matrix is singular");
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

using IntegerMatrix = std::vector<std::vector<Integer>>;

/// A matrix that is the sum of two, or one.
struct Sum {
  Sum(const Eigen::MatrixXd& one)
      : first(one), second(Eigen::MatrixXd::Zero(one.rows(), one.cols())) {}
  Sum(const Eigen::MatrixXd& one, const Eigen::MatrixXd& other) : first(one), second(other) {}
  Eigen::MatrixXd first, second;
};

/// The number times 2^-exponent, which makes it whole.
Integer whole(double x, int exponent) {
  int own = 0;
  const auto mantissa = static_cast<std::int64_t>(std::ldexp(std::frexp(x, &own), 53));
  return mantissa == 0 ? Integer(0) : Integer(mantissa) << (own - 53 - exponent);
}

/// All of them times the same power of two, which makes every entry a whole number.
std::array<IntegerMatrix, 3> integers(const std::array<Sum, 3>& sums) {
  int lowest = std::numeric_limits<int>::max();
  for (const Sum& sum : sums) {
    for (const Eigen::MatrixXd* m : {&sum.first, &sum.second}) {
      for (Eigen::Index i = 0; i < m->size(); ++i) {
        if (!std::isfinite(m->data()[i])) {
          throw std::overflow_error("a matrix entry is not finite");
        }
        int exponent = 0;
        if (std::frexp(m->data()[i], &exponent) != 0.0) {
          lowest = std::min(lowest, exponent - 53);
        }
      }
    }
  }
  std::array<IntegerMatrix, 3> result;
  for (std::size_t k = 0; k < sums.size(); ++k) {
    const auto& [first, second] = sums[k];
    for (Eigen::Index i = 0; i < first.rows(); ++i) {
      result[k].emplace_back();
      for (Eigen::Index j = 0; j < first.cols(); ++j) {
        result[k].back().push_back(whole(first(i, j), lowest) + whole(second(i, j), lowest));
      }
    }
  }
  return result;
}

/// The first times s^2 plus the second times s plus the third.
IntegerMatrix atValue(const std::array<IntegerMatrix, 3>& parts, int s) {
  IntegerMatrix sum = parts[2];
  for (std::size_t i = 0; i < sum.size(); ++i) {
    for (std::size_t j = 0; j < sum.size(); ++j) {
      sum[i][j] += s * (parts[1][i][j] + s * parts[0][i][j]);
    }
  }
  return sum;
}

/// By elimination without fractions (Bareiss, Mathematics of Computation 22, 1968).
Integer determinant(IntegerMatrix m) {
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
        m[i][j] = (m[i][j] * m[k][k] - m[i][k] * m[k][j]) / before;
      }
    }
    before = m[k][k];
  }
  return negative ? Integer(-m.back().back()) : m.back().back();
}

/// The state matrix [0 I; -M^-1 (K + N), -M^-1 (C + G)].
Matrix stateMatrix(const Linearization& l) {
  const auto n = static_cast<std::size_t>(l.mass.rows());
  Matrix mass(n, Row(n));
  Matrix right(n, Row(2 * n));
  for (std::size_t i = 0; i < n; ++i) {
    for (std::size_t j = 0; j < n; ++j) {
      const auto r = static_cast<Eigen::Index>(i);
      const auto c = static_cast<Eigen::Index>(j);
      mass[i][j] = Rational(l.mass(r, c));
      right[i][j] = -(Rational(l.stiffness(r, c)) + Rational(l.circulatory(r, c)));
      right[i][n + j] = -(Rational(l.damping(r, c)) + Rational(l.gyroscopic(r, c)));
    }
  }
  const Matrix accelerations = solve(mass, right);
  Matrix a(2 * n, Row(2 * n));
  for (std::size_t i = 0; i < n; ++i) {
    a[i][n + i] = 1;
    a[n + i] = accelerations[i];
  }
  return a;
}

}  // namespace

std::vector<Rational> characteristicPolynomial(const Linearization& l) {
  const std::array<IntegerMatrix, 3> parts =
      integers({l.mass, {l.damping, l.gyroscopic}, {l.stiffness, l.circulatory}});
  const int n = static_cast<int>(l.mass.rows());
  // det(M s^2 + (C + G) s + K + N) at 2 n + 1 whole numbers s, and Newton's divided differences.
  std::vector<Rational> differences;
  for (int s = -n; s <= n; ++s) {
    differences.emplace_back(determinant(atValue(parts, s)));
  }
  const std::size_t count = differences.size();
  for (std::size_t level = 1; level < count; ++level) {
    for (std::size_t i = count - 1; i >= level; --i) {
      differences[i] = (differences[i] - differences[i - 1]) / static_cast<int>(level);
    }
  }
  std::vector<Rational> polynomial;  // lowest power first
  for (std::size_t i = count; i-- > 0;) {
    const int node = static_cast<int>(i) - n;
    polynomial.insert(polynomial.begin(), Rational(0));  // times (s - node)
    for (std::size_t k = 0; k + 1 < polynomial.size(); ++k) {
      polynomial[k] -= node * polynomial[k + 1];
    }
    polynomial[0] += differences[i];
  }
  const Rational leading = polynomial[count - 1];
  if (leading == 0) {
    throw Refusal("the mass matrix is singular");
  }
  std::vector<Rational> monic;
  for (std::size_t k = count; k-- > 0;) {
    monic.push_back(polynomial[k] / leading);
  }
  return monic;
}

std::vector<Rational> minimalPolynomial(const Linearization& linearization) {
  const Matrix a = stateMatrix(linearization);
  const std::size_t size = a.size();
  // The smallest power A^k b that depends on the lower ones; b has no symmetry that could hide a
  // direction.
  Matrix vector(size, Row(1));
  for (std::size_t i = 0; i < size; ++i) {
    vector[i][0] = Rational(static_cast<long>((7919 * (i + 1) * (i + 1) + 104729) % 65537));
  }
  Matrix rows;          // reduced Krylov vectors ...
  Matrix combinations;  // ... as combinations of b, A b, A^2 b, ...
  std::vector<std::size_t> pivots;
  for (std::size_t k = 0; k <= size; ++k) {
    Row row(size);
    for (std::size_t i = 0; i < size; ++i) {
      row[i] = vector[i][0];
    }
    Row combination(size + 1);
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
    vector = product(a, vector);
  }
  throw std::logic_error("a matrix satisfies its characteristic polynomial");
}

}  // namespace whirl_twin

// L U = P A of the small matrices of a step, by rows and with exchanges of rows. Eigen's
// factorizations of fixed sizes do the same, and take a minute to compile.
#pragma once

#include <array>
#include <cmath>
#include <cstddef>
#include <utility>

namespace whirl_twin {

/// Real-time safe. The solution with a singular matrix is not finite.
template <std::size_t size>
class SmallLu {
 public:
  using Vector = std::array<double, size>;
  using Matrix = std::array<Vector, size>;

  explicit SmallLu(const Matrix& a) noexcept : a_(a) {
    for (std::size_t k = 0; k < size; ++k) {
      std::size_t pivot = k;
      for (std::size_t i = k + 1; i < size; ++i) {
        if (std::fabs(a_[i][k]) > std::fabs(a_[pivot][k])) {
          pivot = i;
        }
      }
      rows_[k] = pivot;
      std::swap(a_[k], a_[pivot]);
      a_[k][k] = 1.0 / a_[k][k];
      for (std::size_t i = k + 1; i < size; ++i) {
        const double factor = a_[i][k] * a_[k][k];
        a_[i][k] = factor;
        for (std::size_t j = k + 1; j < size; ++j) {
          a_[i][j] -= factor * a_[k][j];
        }
      }
    }
  }

  /// x with A x = b, in place of b, of `size` numbers.
  void solve(double* b) const noexcept {
    for (std::size_t k = 0; k < size; ++k) {
      std::swap(b[k], b[rows_[k]]);
    }
    for (std::size_t i = 1; i < size; ++i) {
      for (std::size_t j = 0; j < i; ++j) {
        b[i] -= a_[i][j] * b[j];
      }
    }
    for (std::size_t i = size; i-- > 0;) {
      for (std::size_t j = i + 1; j < size; ++j) {
        b[i] -= a_[i][j] * b[j];
      }
      b[i] *= a_[i][i];
    }
  }

 private:
  Matrix a_;  // L below the diagonal, U above, the inverse of U's diagonal on it
  std::array<std::size_t, size> rows_;
};

}  // namespace whirl_twin

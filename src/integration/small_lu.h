// L U = P A of the small matrices of a step, by rows and with exchanges of rows: in one copy for
// all sizes. Eigen's of fixed sizes are another copy for each, which take a minute to compile.
#pragma once

#include <array>
#include <cstddef>

namespace whirl_twin {

/// Factorizes in place a matrix of `size` rows, one after the other; `rows`: as many numbers.
/// Real-time safe.
void factorizeSmall(double* a, std::size_t* rows, std::size_t size) noexcept;
/// x with A x = b, in place of b. Real-time safe.
void solveSmall(const double* a, const std::size_t* rows, std::size_t size, double* b) noexcept;

template <std::size_t size>
class SmallLu {
 public:
  using Vector = std::array<double, size>;
  using Matrix = std::array<Vector, size>;

  explicit SmallLu(const Matrix& a) noexcept : a_(a) {
    factorizeSmall(a_[0].data(), rows_.data(), size);
  }
  void solve(double* b) const noexcept { solveSmall(a_[0].data(), rows_.data(), size, b); }

 private:
  Matrix a_;
  std::array<std::size_t, size> rows_;
};

}  // namespace whirl_twin

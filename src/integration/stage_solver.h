// The linear equations of a simplified Newton step on the stages of a collocation method
// (Hairer & Wanner, Solving Ordinary Differential Equations II, IV.8), for q'' = a(q, v, t).
#pragma once

#include <Eigen/Core>
#include <Eigen/LU>
#include <array>
#include <cstddef>

#include "integration/acceleration_jacobian.h"

namespace whirl_twin {

template <std::size_t stages, std::size_t n>
class StageSolver {
 public:
  using Table = std::array<std::array<double, stages>, stages>;
  using Stages = std::array<std::array<double, n>, stages>;

  // Real-time safe.

  /// Factorizes I - h (A x da/dv + h A^2 x da/dq), `a` and `aa` being A and A^2.
  StageSolver(double h, const Table& a, const Table& aa,
              const AccelerationJacobian<n>& jacobian) noexcept;
  /// The correction of the stages' accelerations that a residual [as them] asks for.
  Stages solve(const Stages& residual) const noexcept;

 private:
  static constexpr int kSize = static_cast<int>(stages * n);

  Eigen::PartialPivLU<Eigen::Matrix<double, kSize, kSize>> factors_;
};

template <std::size_t stages, std::size_t n>
StageSolver<stages, n>::StageSolver(double h, const Table& a, const Table& aa,
                                    const AccelerationJacobian<n>& jacobian) noexcept {
  constexpr int kDof = static_cast<int>(n);
  Eigen::Matrix<double, kSize, kSize> matrix;
  for (std::size_t k = 0; k < stages; ++k) {
    for (std::size_t l = 0; l < stages; ++l) {
      matrix.template block<kDof, kDof>(static_cast<int>(k * n), static_cast<int>(l * n)) =
          -h * (a[k][l] * jacobian.by_v + h * aa[k][l] * jacobian.by_q);
    }
  }
  matrix.diagonal().array() += 1.0;
  factors_.compute(matrix);
}

template <std::size_t stages, std::size_t n>
typename StageSolver<stages, n>::Stages StageSolver<stages, n>::solve(
    const Stages& residual) const noexcept {
  using Vector = Eigen::Matrix<double, kSize, 1>;
  Stages correction;
  Eigen::Map<Vector>(correction[0].data()) =
      factors_.solve(Eigen::Map<const Vector>(residual[0].data()));
  return correction;
}

// Compiled once for the numbers of coordinates that the package's own models have.
#define WHIRL_TWIN_STAGE_SOLVERS(storage, n) \
  storage template class StageSolver<1, n>;  \
  storage template class StageSolver<2, n>;  \
  storage template class StageSolver<3, n>;
WHIRL_TWIN_STAGE_SOLVERS(extern, 1)
WHIRL_TWIN_STAGE_SOLVERS(extern, 2)
WHIRL_TWIN_STAGE_SOLVERS(extern, 3)
WHIRL_TWIN_STAGE_SOLVERS(extern, 4)

}  // namespace whirl_twin

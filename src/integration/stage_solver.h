// The linear equations of a simplified Newton step on the stages of a collocation method
// (Hairer & Wanner, Solving Ordinary Differential Equations II, IV.8), for q'' = a(q, v, t).
#pragma once

#include <Eigen/Core>
#include <array>
#include <cstddef>

#include "integration/small_lu.h"
#include "mechanics/lagrangian.h"

namespace whirl_twin {

// How accelerations change with the state: what implicit and exact steps ask of the equations.

/// da/dq and da/dv.
template <std::size_t n>
struct AccelerationJacobian {
  Eigen::Matrix<double, static_cast<int>(n), static_cast<int>(n)> by_q, by_v;
};

/// Of M q'' + (C + G) q' + (K + N) q = 0. Real-time safe.
template <std::size_t n>
AccelerationJacobian<n> accelerationJacobian(const FixedLinearization<n>& l) noexcept {
  typename SmallLu<n>::Matrix mass;
  for (std::size_t i = 0; i < n; ++i) {
    for (std::size_t j = 0; j < n; ++j) {
      mass[i][j] = l.mass(i, j);
    }
  }
  const SmallLu<n> factors(mass);
  AccelerationJacobian<n> jacobian;
  for (std::size_t j = 0; j < n; ++j) {
    std::array<double, n> by_q;
    std::array<double, n> by_v;
    for (std::size_t i = 0; i < n; ++i) {
      by_q[i] = -(l.stiffness(i, j) + l.circulatory(i, j));
      by_v[i] = -(l.damping(i, j) + l.gyroscopic(i, j));
    }
    factors.solve(by_q.data());
    factors.solve(by_v.data());
    for (std::size_t i = 0; i < n; ++i) {
      jacobian.by_q(i, j) = by_q[i];
      jacobian.by_v(i, j) = by_v[i];
    }
  }
  return jacobian;
}

template <std::size_t stages, std::size_t n>
class StageSolver {
 public:
  using Table = std::array<std::array<double, stages>, stages>;
  using Stages = std::array<std::array<double, n>, stages>;

  // Real-time safe.

  /// Factorizes I - h (A x da/dv + h A^2 x da/dq), `a` and `aa` being A and A^2.
  StageSolver(double h, const Table& a, const Table& aa,
              const AccelerationJacobian<n>& jacobian) noexcept
      : factors_(matrix(h, a, aa, jacobian)) {}
  /// The correction of the stages' accelerations for a residual in the same units.
  Stages solve(const Stages& residual) const noexcept {
    Stages correction = residual;
    factors_.solve(correction[0].data());
    return correction;
  }

 private:
  using Factors = SmallLu<stages * n>;

  static typename Factors::Matrix matrix(double h, const Table& a, const Table& aa,
                                         const AccelerationJacobian<n>& jacobian) noexcept {
    typename Factors::Matrix matrix;
    for (std::size_t k = 0; k < stages; ++k) {
      for (std::size_t l = 0; l < stages; ++l) {
        for (std::size_t i = 0; i < n; ++i) {
          for (std::size_t j = 0; j < n; ++j) {
            const double one = k == l && i == j ? 1.0 : 0.0;
            matrix[k * n + i][l * n + j] =
                one - h * (a[k][l] * jacobian.by_v(i, j) + h * aa[k][l] * jacobian.by_q(i, j));
          }
        }
      }
    }
    return matrix;
  }

  Factors factors_;
};

}  // namespace whirl_twin

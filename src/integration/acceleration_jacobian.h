// How accelerations change with the state: what implicit and exact steps ask of the equations.
#pragma once

#include <Eigen/Core>
#include <array>
#include <cstddef>

#include "integration/small_lu.h"
#include "mechanics/lagrangian.h"

namespace whirl_twin {

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

}  // namespace whirl_twin

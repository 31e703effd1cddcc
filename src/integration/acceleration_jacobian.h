// How accelerations change with the state: what implicit and exact steps ask of the equations.
#pragma once

#include <Eigen/Core>
#include <Eigen/LU>
#include <cstddef>

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
  // Not mass.inverse(): Eigen's of size four needs signed zeros, which steps are compiled without.
  const auto mass = l.mass.partialPivLu();
  return {-mass.solve(l.stiffness + l.circulatory), -mass.solve(l.damping + l.gyroscopic)};
}

// Compiled once for the numbers of coordinates that the package's own models have.
extern template AccelerationJacobian<1> accelerationJacobian(const FixedLinearization<1>&) noexcept;
extern template AccelerationJacobian<2> accelerationJacobian(const FixedLinearization<2>&) noexcept;
extern template AccelerationJacobian<3> accelerationJacobian(const FixedLinearization<3>&) noexcept;
extern template AccelerationJacobian<4> accelerationJacobian(const FixedLinearization<4>&) noexcept;

}  // namespace whirl_twin

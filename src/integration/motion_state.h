// The state a step advances: coordinates, rates, and the work that the energy audit sums up.
//
// Each number is kept as a sum high + low (compensated summation: Kahan 1965; Hairer, Lubich &
// Wanner, Geometric Numerical Integration, VIII.5), so that a billion small increments lose
// nothing.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>

#include "mechanics/force_inline.h"

namespace whirl_twin {

enum class StepStatus : std::uint8_t {
  kOk = 0,
  kNotFinite = 1,       ///< the new state has an infinity or a NaN
  kNotConverged = 2,    ///< an implicit step found no solution
  kOutOfRange = 3,      ///< the shaft runs at a speed that the step was not prepared for
  kControllerLost = 4,  ///< one in a different process, and the plant was to stop then
  kNoGap = 5,           ///< a magnetic bearing has no gap left: the rotor touches its poles
};

/// sum + increment without losing what does not fit: sum.high is the nearest double.
struct CompensatedSum {
  double high = 0.0;
  double low = 0.0;

  WHIRL_TWIN_INLINE void add(double increment) {
    const double corrected = increment + low;
    const double sum = high + corrected;
    low = corrected - (sum - high);
    high = sum;
  }
};

template <std::size_t n>
struct MotionState {
  std::array<double, n> q{};  ///< [rad] or [m]
  std::array<double, n> v{};  ///< [rad/s] or [m/s]
  std::array<double, n> q_low{};
  std::array<double, n> v_low{};
  CompensatedSum work;  ///< [J], integral of dh/dt

  WHIRL_TWIN_INLINE void advance(const std::array<double, n>& dq, const std::array<double, n>& dv,
                                 double energy) {
    for (std::size_t i = 0; i < n; ++i) {
      CompensatedSum position{q[i], q_low[i]};
      position.add(dq[i]);
      q[i] = position.high;
      q_low[i] = position.low;
      CompensatedSum rate{v[i], v_low[i]};
      rate.add(dv[i]);
      v[i] = rate.high;
      v_low[i] = rate.low;
    }
    work.add(energy);
  }
};

}  // namespace whirl_twin

// The motion of a rotor of two coordinates, each number as a compensated sum (motion_state.h).
#pragma once

#include <array>

#include "integration/finite.h"
#include "integration/motion_state.h"

namespace whirl_twin {

struct LateralMotion {
  alignas(32) std::array<double, 4> y{};    ///< x, y [m], x', y' [m/s]
  alignas(32) std::array<double, 4> low{};  ///< what their doubles leave out
  CompensatedSum work;                      ///< [J], integral of dh/dt

  void advance(const std::array<double, 4>& increment, double energy) noexcept {
    for (std::size_t i = 0; i < y.size(); ++i) {
      CompensatedSum sum{y[i], low[i]};
      sum.add(increment[i]);
      y[i] = sum.high;
      low[i] = sum.low;
    }
    work.add(energy);
  }
};

inline bool isFinite(const LateralMotion& motion) noexcept {
  return isFinite(motion.y[0]) && isFinite(motion.y[1]) && isFinite(motion.y[2]) &&
         isFinite(motion.y[3]) && isFinite(motion.work.high);
}

}  // namespace whirl_twin

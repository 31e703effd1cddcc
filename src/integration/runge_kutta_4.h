// The classical Runge-Kutta method of order 4 (Kutta 1901; Hairer, Norsett & Wanner, Solving
// Ordinary Differential Equations I, II.1) on (q, v, work).
//
//   0   |
//   1/2 | 1/2
//   1/2 |     1/2
//   1   |          1
//       | 1/6 1/3 1/3 1/6
//
// Order 4, explicit, four evaluations. Not symplectic: it loses energy of order h^5 a step, so it
// is wrong for months of undamped swing. Stable for h |lambda| < 2.83 on the imaginary axis.
#pragma once

#include "integration/motion_state.h"

namespace whirl_twin {

struct RungeKutta4 {
  static constexpr const char* kName = "runge_kutta_4";

  void restart() {}

  /// Advances by h [s] from offset [s] after the start of the twin's step.
  template <std::size_t n, class Equation>
  WHIRL_TWIN_INLINE StepStatus step(const Equation& equation, double offset, double h,
                                    MotionState<n>& state) {
    std::array<double, n> q = state.q;
    std::array<double, n> v2;
    std::array<double, n> v3;
    std::array<double, n> v4;
    const auto k1 = equation(q, state.v, offset);
    for (std::size_t i = 0; i < n; ++i) {
      q[i] = state.q[i] + 0.5 * h * state.v[i];
      v2[i] = state.v[i] + 0.5 * h * k1.acceleration[i];
    }
    const auto k2 = equation(q, v2, offset + 0.5 * h);
    for (std::size_t i = 0; i < n; ++i) {
      q[i] = state.q[i] + 0.5 * h * v2[i];
      v3[i] = state.v[i] + 0.5 * h * k2.acceleration[i];
    }
    const auto k3 = equation(q, v3, offset + 0.5 * h);
    for (std::size_t i = 0; i < n; ++i) {
      q[i] = state.q[i] + h * v3[i];
      v4[i] = state.v[i] + h * k3.acceleration[i];
    }
    const auto k4 = equation(q, v4, offset + h);
    std::array<double, n> dq;
    std::array<double, n> dv;
    for (std::size_t i = 0; i < n; ++i) {
      dq[i] = h / 6.0 * (state.v[i] + 2.0 * (v2[i] + v3[i]) + v4[i]);
      dv[i] = h / 6.0 *
              (k1.acceleration[i] + 2.0 * (k2.acceleration[i] + k3.acceleration[i]) +
               k4.acceleration[i]);
    }
    state.advance(dq, dv, h / 6.0 * (k1.power + 2.0 * (k2.power + k3.power) + k4.power));
    return StepStatus::kOk;
  }
};

}  // namespace whirl_twin

// Velocity Verlet (Stoermer):
//   q1 = q0 + h v0 + h^2/2 a0,   v1 = v0 + h/2 (a0 + a(q1, v0 + h a0))
//
// Order 2. Symplectic and time-reversible where the forces do not depend on the rates (Hairer,
// Lubich & Wanner, Geometric Numerical Integration, I.1.4). Rate-dependent forces at the end of the
// step are evaluated at the predicted rate v0 + h a0: still order 2, no longer symplectic, and
// undamped gyroscopic systems may grow slowly. Stable for h |lambda| < 2 on an undamped oscillator.
#pragma once

#include "integration/motion_state.h"

namespace whirl_twin {

struct VelocityVerlet {
  static constexpr const char* kName = "velocity_verlet";

  void restart() {}

  /// Advances by h [s] from offset [s] after the start of the twin's step.
  template <std::size_t n, class Equation>
  WHIRL_TWIN_INLINE StepStatus step(const Equation& equation, double offset, double h,
                                    MotionState<n>& state) {
    const auto start = equation(state.q, state.v, offset);
    std::array<double, n> dq;
    std::array<double, n> dv;
    std::array<double, n> end_q;
    std::array<double, n> end_v;
    for (std::size_t i = 0; i < n; ++i) {
      dq[i] = h * (state.v[i] + 0.5 * h * start.acceleration[i]);
      end_q[i] = state.q[i] + dq[i];
      end_v[i] = state.v[i] + h * start.acceleration[i];
    }
    const auto end = equation(end_q, end_v, offset + h);
    for (std::size_t i = 0; i < n; ++i) {
      dv[i] = 0.5 * h * (start.acceleration[i] + end.acceleration[i]);
    }
    state.advance(dq, dv, 0.5 * h * (start.power + end.power));
    return StepStatus::kOk;
  }
};

}  // namespace whirl_twin

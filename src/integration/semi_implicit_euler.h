// Semi-implicit (symplectic) Euler:  v1 = v0 + h a(q0, v0),  q1 = q0 + h v1.
//
// Order 1. Symplectic for T(v) + V(q) systems: there the energy error stays bounded of order h.
// (Hairer, Lubich & Wanner, Geometric Numerical Integration, VI.3.) Forces that depend on the rates
// are taken explicitly at the start of the step: gyroscopic terms make it unstable at any step
// without damping, and it guarantees nothing about accuracy beyond h |lambda| << 1.
// Stable for h |lambda| < 2 on an undamped oscillator.
#pragma once

#include "integration/motion_state.h"
#include "integration/simd_vector.h"

namespace whirl_twin {

struct SemiImplicitEuler {
  static constexpr const char* kName = "semi_implicit_euler";

  void restart() {}

  /// Advances by h [s] from offset [s] after the start of the twin's step.
  template <std::size_t n, class Equation>
  WHIRL_TWIN_INLINE StepStatus step(const Equation& equation, double offset, double h,
                                    MotionState<n>& state) {
    const auto start = equation(state.q, state.v, offset);
    Lanes<n> dv{};
    dv.add(h, Lanes<n>(start.acceleration));
    Lanes<n> dq{};
    dq.add(h, Lanes<n>(state.v) + dv);
    state.advance(dq.array(), dv.array(), h * start.power);
    return StepStatus::kOk;
  }
};

}  // namespace whirl_twin

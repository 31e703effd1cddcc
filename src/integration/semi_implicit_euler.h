// Semi-implicit (symplectic) Euler:  v1 = v0 + h a(q0, v0),  q1 = q0 + h v1.
//
// Order 1. Symplectic for T(v) + V(q) systems: there the energy error stays bounded of order h.
// (Hairer, Lubich & Wanner, Geometric Numerical Integration, VI.3.) Rate-dependent forces are
// evaluated explicitly at the start of the step: gyroscopic terms make it unstable at any step
// without damping, and it is accurate for h |lambda| << 1 only. Stable for h |lambda| < 2 on an
// undamped oscillator.
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
    SimdVector<n> dv{};
    dv.add(h, SimdVector<n>(start.acceleration));
    SimdVector<n> dq{};
    dq.add(h, SimdVector<n>(state.v) + dv);
    state.advance(dq.array(), dv.array(), h * start.power);
    return StepStatus::kOk;
  }
};

}  // namespace whirl_twin

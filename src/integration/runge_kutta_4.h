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
#include "integration/simd_vector.h"

namespace whirl_twin {

struct RungeKutta4 {
  static constexpr const char* kName = "runge_kutta_4";

  void restart() {}

  /// Advances by h [s] from offset [s] after the start of the twin's step.
  template <std::size_t n, class Equation>
  WHIRL_TWIN_INLINE StepStatus step(const Equation& equation, double offset, double h,
                                    MotionState<n>& state) {
    constexpr std::size_t kStages = 4;
    constexpr std::array<double, kStages> kNodes{0.0, 0.5, 0.5, 1.0};
    using SimdVector = whirl_twin::SimdVector<n>;
    const SimdVector q0(state.q);
    const SimdVector v0(state.v);
    std::array<SimdVector, kStages> rates;
    std::array<SimdVector, kStages> accelerations;
    std::array<double, kStages> powers;
    SimdVector q = q0;
    SimdVector v = v0;
    const auto stage = [&](std::size_t k) WHIRL_TWIN_FLAT {
      const auto found = equation(q.array(), v.array(), offset + kNodes[k] * h);
      rates[k] = v;
      accelerations[k] = SimdVector(found.acceleration);
      powers[k] = found.power;
      const double ahead = h * kNodes[k + 1 < kStages ? k + 1 : k];
      q = q0;
      q.add(ahead, v);
      v = v0;
      v.add(ahead, accelerations[k]);
    };
    // One copy of the equations: what they make of the parameters alone is then computed once. But
    // short ones wait for what a loop stores.
    if constexpr (n == 1) {
      unrolled<kStages>(stage);
    } else {
#pragma GCC unroll 1
      for (std::size_t k = 0; k < kStages; ++k) {
        stage(k);
      }
    }
    // At the end and not on the way: the stages would wait for sums.
    const auto mean = [](const auto& of) {
      SimdVector sum = of[1] + of[2];
      sum = sum + sum + of[0] + of[3];
      return sum;
    };
    SimdVector dq{};
    dq.add(h / 6.0, mean(rates));
    SimdVector dv{};
    dv.add(h / 6.0, mean(accelerations));
    const double energy = h / 6.0 * (powers[0] + 2.0 * (powers[1] + powers[2]) + powers[3]);
    state.advance(dq.array(), dv.array(), energy);
    return StepStatus::kOk;
  }
};

}  // namespace whirl_twin

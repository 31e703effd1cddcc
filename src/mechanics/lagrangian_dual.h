// The dual number that carries just what the Euler-Lagrange equations ask of T(q, v, t):
//
//   f,  df/dq_j,  df/dv_j,  d2f/dv_j dv_k  (the mass matrix),
//   f' = v . df/dq + df/dt  (the rate along the motion with v held),  df/dt,  and  d(f')/dv_j
//   without the term df/dq_j, i.e.  (d2f/dv_j dq) v + d2f/dv_j dt.
//
// q is seeded with dq_j = 1 and rate v_j, v with dv_j = 1 and rate 0, time with rate 1. Second
// derivatives by q alone, which a general second-order dual would carry, are never needed.
// The base B is double in a step, Gradient<double, 2n> for a linearization. Plain arrays:
// force_inline.h.
#pragma once

#include <cstddef>

#include "mechanics/elementary.h"
#include "mechanics/force_inline.h"

namespace whirl_twin {

template <class B, std::size_t n>
struct LagrangianDual {
  static constexpr std::size_t kPairs = n * (n + 1) / 2;

  B value{};
  B by_q[n]{};
  B by_v[n]{};
  B by_vv[kPairs]{};  ///< packed lower triangle: (j, k), k <= j, at j (j + 1) / 2 + k
  B rate{};           ///< along q' = v, t' = 1
  B by_t{};           ///< df/dt, with q and v held
  B by_v_rate[n]{};   ///< (d2/dv_j dq) v + d2/dv_j dt

  LagrangianDual() = default;
  WHIRL_TWIN_INLINE LagrangianDual(double constant) : value(constant) {}  // NOLINT: a constant
  WHIRL_TWIN_INLINE static LagrangianDual coordinate(const B& q, const B& v, std::size_t j) {
    LagrangianDual r;
    r.value = q;
    r.by_q[j] = B(1.0);
    r.rate = v;
    return r;
  }
  WHIRL_TWIN_INLINE static LagrangianDual velocity(const B& v, std::size_t j) {
    LagrangianDual r;
    r.value = v;
    r.by_v[j] = B(1.0);
    return r;
  }
  /// A known function of time: its value and its rate.
  WHIRL_TWIN_INLINE static LagrangianDual known(const B& at, const B& at_rate) {
    LagrangianDual r;
    r.value = at;
    r.rate = at_rate;
    r.by_t = at_rate;
    return r;
  }

  /// g(x) by the chain rule.
  WHIRL_TWIN_INLINE LagrangianDual through(const Jet<B>& g) const {
    LagrangianDual r;
    r.value = g.value;
    r.rate = g.slope * rate;
    r.by_t = g.slope * by_t;
    unrolled<n>([&](auto j) WHIRL_TWIN_FLAT {
      r.by_q[j] = g.slope * by_q[j];
      r.by_v[j] = g.slope * by_v[j];
      r.by_v_rate[j] = g.slope * by_v_rate[j] + g.curvature * (by_v[j] * rate);
      unrolled<decltype(j)::value + 1>([&](auto k) WHIRL_TWIN_FLAT {
        const std::size_t p = j * (j + 1) / 2 + k;
        r.by_vv[p] = g.slope * by_vv[p] + g.curvature * (by_v[j] * by_v[k]);
      });
    });
    return r;
  }

  friend WHIRL_TWIN_INLINE LagrangianDual operator+(const LagrangianDual& a,
                                                    const LagrangianDual& b) {
    LagrangianDual r;
    r.value = a.value + b.value;
    r.rate = a.rate + b.rate;
    r.by_t = a.by_t + b.by_t;
    unrolled<n>([&](auto j) WHIRL_TWIN_FLAT {
      r.by_q[j] = a.by_q[j] + b.by_q[j];
      r.by_v[j] = a.by_v[j] + b.by_v[j];
      r.by_v_rate[j] = a.by_v_rate[j] + b.by_v_rate[j];
    });
    unrolled<kPairs>([&](auto p) WHIRL_TWIN_FLAT { r.by_vv[p] = a.by_vv[p] + b.by_vv[p]; });
    return r;
  }
  friend WHIRL_TWIN_INLINE LagrangianDual operator*(double a, const LagrangianDual& b) {
    LagrangianDual r;
    r.value = a * b.value;
    r.rate = a * b.rate;
    r.by_t = a * b.by_t;
    unrolled<n>([&](auto j) WHIRL_TWIN_FLAT {
      r.by_q[j] = a * b.by_q[j];
      r.by_v[j] = a * b.by_v[j];
      r.by_v_rate[j] = a * b.by_v_rate[j];
    });
    unrolled<kPairs>([&](auto p) WHIRL_TWIN_FLAT { r.by_vv[p] = a * b.by_vv[p]; });
    return r;
  }
  friend WHIRL_TWIN_INLINE LagrangianDual operator*(const LagrangianDual& a,
                                                    const LagrangianDual& b) {
    LagrangianDual r;
    r.value = a.value * b.value;
    r.rate = a.value * b.rate + a.rate * b.value;
    r.by_t = a.value * b.by_t + a.by_t * b.value;
    unrolled<n>([&](auto j) WHIRL_TWIN_FLAT {
      r.by_q[j] = a.value * b.by_q[j] + a.by_q[j] * b.value;
      r.by_v[j] = a.value * b.by_v[j] + a.by_v[j] * b.value;
      r.by_v_rate[j] = a.value * b.by_v_rate[j] + a.by_v_rate[j] * b.value + a.by_v[j] * b.rate +
                       a.rate * b.by_v[j];
      unrolled<decltype(j)::value + 1>([&](auto k) WHIRL_TWIN_FLAT {
        const std::size_t p = j * (j + 1) / 2 + k;
        r.by_vv[p] = a.value * b.by_vv[p] + a.by_vv[p] * b.value + a.by_v[j] * b.by_v[k] +
                     a.by_v[k] * b.by_v[j];
      });
    });
    return r;
  }
  friend WHIRL_TWIN_INLINE LagrangianDual operator-(const LagrangianDual& a) { return -1.0 * a; }
  friend WHIRL_TWIN_INLINE LagrangianDual operator-(const LagrangianDual& a,
                                                    const LagrangianDual& b) {
    return a + (-1.0 * b);
  }
  friend WHIRL_TWIN_INLINE LagrangianDual operator/(const LagrangianDual& a,
                                                    const LagrangianDual& b) {
    return a * b.through(reciprocalJet(b.value));
  }
  friend WHIRL_TWIN_INLINE LagrangianDual operator*(const LagrangianDual& a, double b) {
    return b * a;
  }
  friend WHIRL_TWIN_INLINE LagrangianDual operator/(const LagrangianDual& a, double b) {
    return (1.0 / b) * a;
  }
  friend WHIRL_TWIN_INLINE LagrangianDual operator/(double a, const LagrangianDual& b) {
    return a * b.through(reciprocalJet(b.value));
  }
  friend WHIRL_TWIN_INLINE LagrangianDual operator+(const LagrangianDual& a, double b) {
    LagrangianDual r = a;
    r.value = a.value + b;
    return r;
  }
  friend WHIRL_TWIN_INLINE LagrangianDual operator+(double a, const LagrangianDual& b) {
    return b + a;
  }
  friend WHIRL_TWIN_INLINE LagrangianDual operator-(const LagrangianDual& a, double b) {
    return a + (-b);
  }
  friend WHIRL_TWIN_INLINE LagrangianDual operator-(double a, const LagrangianDual& b) {
    return (-b) + a;
  }

  friend WHIRL_TWIN_INLINE LagrangianDual sin(const LagrangianDual& x) {
    return x.through(sinJet(x.value));
  }
  friend WHIRL_TWIN_INLINE LagrangianDual cos(const LagrangianDual& x) {
    return x.through(cosJet(x.value));
  }
  friend WHIRL_TWIN_INLINE LagrangianDual cosOfDifference(const LagrangianDual& a,
                                                          const LagrangianDual& b) {
    return (a - b).through(cosOfDifferenceJet(a.value, b.value));
  }
  friend WHIRL_TWIN_INLINE LagrangianDual sqrt(const LagrangianDual& x) {
    return x.through(sqrtJet(x.value));
  }
  friend WHIRL_TWIN_INLINE LagrangianDual tanh(const LagrangianDual& x) {
    return x.through(tanhJet(x.value));
  }
  friend WHIRL_TWIN_INLINE LagrangianDual atan(const LagrangianDual& x) {
    return x.through(atanJet(x.value));
  }
};

}  // namespace whirl_twin

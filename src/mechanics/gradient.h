// First-order forward dual number: a value and its derivatives in N directions.
//
// Used for the potential (derivatives by the coordinates and by time), the Rayleigh dissipation (by
// the rates), and as the base of LagrangianDual where a linearization is required.
#pragma once

#include <cstddef>

#include "mechanics/elementary.h"
#include "mechanics/force_inline.h"

namespace whirl_twin {

template <class B, std::size_t N>
struct Gradient {
  B value{};
  B slope[N]{};  ///< plain: force_inline.h

  Gradient() = default;
  WHIRL_TWIN_INLINE Gradient(double constant) : value(constant) {}  // NOLINT: a constant is a dual
  WHIRL_TWIN_INLINE Gradient(const B& at, std::size_t direction) : value(at) {
    slope[direction] = B(1.0);
  }

  /// g(x) by the chain rule.
  WHIRL_TWIN_INLINE Gradient through(const Jet<B>& g) const {
    Gradient r;
    r.value = g.value;
    unrolled<N>([&](auto i) WHIRL_TWIN_FLAT { r.slope[i] = g.slope * slope[i]; });
    return r;
  }

  friend WHIRL_TWIN_INLINE Gradient operator+(const Gradient& a, const Gradient& b) {
    Gradient r;
    r.value = a.value + b.value;
    unrolled<N>([&](auto i) WHIRL_TWIN_FLAT { r.slope[i] = a.slope[i] + b.slope[i]; });
    return r;
  }
  friend WHIRL_TWIN_INLINE Gradient operator-(const Gradient& a, const Gradient& b) {
    Gradient r;
    r.value = a.value - b.value;
    unrolled<N>([&](auto i) WHIRL_TWIN_FLAT { r.slope[i] = a.slope[i] - b.slope[i]; });
    return r;
  }
  friend WHIRL_TWIN_INLINE Gradient operator*(const Gradient& a, const Gradient& b) {
    Gradient r;
    r.value = a.value * b.value;
    unrolled<N>([&](auto i)
                    WHIRL_TWIN_FLAT { r.slope[i] = a.slope[i] * b.value + a.value * b.slope[i]; });
    return r;
  }
  friend WHIRL_TWIN_INLINE Gradient operator*(double a, const Gradient& b) {
    Gradient r;
    r.value = a * b.value;
    unrolled<N>([&](auto i) WHIRL_TWIN_FLAT { r.slope[i] = a * b.slope[i]; });
    return r;
  }
  friend WHIRL_TWIN_INLINE Gradient operator/(const Gradient& a, const Gradient& b) {
    return a * b.through(reciprocalJet(b.value));
  }
  friend WHIRL_TWIN_INLINE Gradient operator-(const Gradient& a) { return -1.0 * a; }
  friend WHIRL_TWIN_INLINE Gradient operator*(const Gradient& a, double b) { return b * a; }
  friend WHIRL_TWIN_INLINE Gradient operator/(const Gradient& a, double b) { return (1.0 / b) * a; }
  friend WHIRL_TWIN_INLINE Gradient operator/(double a, const Gradient& b) {
    return a * b.through(reciprocalJet(b.value));
  }
  friend WHIRL_TWIN_INLINE Gradient operator+(const Gradient& a, double b) {
    Gradient r = a;
    r.value = a.value + b;
    return r;
  }
  friend WHIRL_TWIN_INLINE Gradient operator+(double a, const Gradient& b) { return b + a; }
  friend WHIRL_TWIN_INLINE Gradient operator-(const Gradient& a, double b) { return a + (-b); }
  friend WHIRL_TWIN_INLINE Gradient operator-(double a, const Gradient& b) { return (-b) + a; }

  // A law of several branches chooses by the value.
  friend WHIRL_TWIN_INLINE bool operator<(const Gradient& a, double b) { return a.value < b; }
  friend WHIRL_TWIN_INLINE bool operator>(const Gradient& a, double b) { return a.value > b; }
  friend WHIRL_TWIN_INLINE bool operator<=(const Gradient& a, double b) { return a.value <= b; }
  friend WHIRL_TWIN_INLINE bool operator>=(const Gradient& a, double b) { return a.value >= b; }

  friend WHIRL_TWIN_INLINE Gradient sin(const Gradient& x) { return x.through(sinJet(x.value)); }
  friend WHIRL_TWIN_INLINE Gradient cos(const Gradient& x) { return x.through(cosJet(x.value)); }
  friend WHIRL_TWIN_INLINE Gradient cosOfDifference(const Gradient& a, const Gradient& b) {
    return (a - b).through(cosOfDifferenceJet(a.value, b.value));
  }
  friend WHIRL_TWIN_INLINE Gradient sqrt(const Gradient& x) { return x.through(sqrtJet(x.value)); }
  friend WHIRL_TWIN_INLINE Gradient tanh(const Gradient& x) { return x.through(tanhJet(x.value)); }
  friend WHIRL_TWIN_INLINE Gradient atan(const Gradient& x) { return x.through(atanJet(x.value)); }
};

}  // namespace whirl_twin

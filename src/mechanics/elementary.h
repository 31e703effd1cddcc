// Elementary functions with their first two derivatives, for the dual numbers of this room.
//
// A function is one row: its value g, slope g' and curvature g'' at x. Both number types use the
// same rows, so a function added here is known to all of them.
#pragma once

#include <cmath>

#include "mechanics/force_inline.h"

namespace whirl_twin {

// Energies are written once for every number type, plain doubles among them.
using std::atan;
using std::cos;
using std::sin;
using std::sqrt;
using std::tanh;

/// Value, first and second derivative of a function of one variable.
template <class B>
struct Jet {
  B value;
  B slope;
  B curvature;
};

template <class B>
WHIRL_TWIN_INLINE Jet<B> sinJet(const B& x) {
  const B s = sin(x);
  return {s, cos(x), -s};
}

template <class B>
WHIRL_TWIN_INLINE Jet<B> cosJet(const B& x) {
  const B c = cos(x);
  return {c, -sin(x), -c};
}

template <class B>
WHIRL_TWIN_INLINE Jet<B> sqrtJet(const B& x) {
  const B root = sqrt(x);
  const B slope = 0.5 / root;
  return {root, slope, -0.5 * slope / x};
}

template <class B>
WHIRL_TWIN_INLINE Jet<B> tanhJet(const B& x) {
  const B t = tanh(x);
  const B slope = 1.0 - t * t;
  return {t, slope, -2.0 * t * slope};
}

template <class B>
WHIRL_TWIN_INLINE Jet<B> atanJet(const B& x) {
  const B slope = 1.0 / (1.0 + x * x);
  return {atan(x), slope, -2.0 * x * slope * slope};
}

template <class B>
WHIRL_TWIN_INLINE Jet<B> reciprocalJet(const B& x) {
  const B r = 1.0 / x;
  return {r, -r * r, 2.0 * r * r * r};
}

}  // namespace whirl_twin

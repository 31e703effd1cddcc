// Elementary functions with their first two derivatives, for the dual numbers of this module.
//
// A function is one row: its value g, slope g' and curvature g'' at x. Both number types use the
// same rows, so a function added here is available to both.
#pragma once

#include <cmath>
#include <type_traits>

#include "mechanics/force_inline.h"
#include "mechanics/sine_cosine.h"

namespace whirl_twin {

// Energies are written once for every number type, plain doubles among them.
using std::atan;
using std::sqrt;
using std::tanh;

// Of doubles only, as templates: a model in a separate namespace with `using namespace whirl_twin`
// sees the C library's ::sin too, and plain functions would be ambiguous beside it.
template <class S, std::enable_if_t<std::is_same_v<S, double>, int> = 0>
WHIRL_TWIN_INLINE S sin(S x) {
  return sineCosine(x).sine;
}
template <class S, std::enable_if_t<std::is_same_v<S, double>, int> = 0>
WHIRL_TWIN_INLINE S cos(S x) {
  return sineCosine(x).cosine;
}

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

/// cos(a - b) as a function of a - b, from the sines and cosines of a and b, where an energy has
/// those anyway.
template <class B>
WHIRL_TWIN_INLINE Jet<B> cosOfDifferenceJet(const B& a, const B& b) {
  const B cos_a = cos(a);
  const B sin_a = sin(a);
  const B cos_b = cos(b);
  const B sin_b = sin(b);
  const B c = cos_a * cos_b + sin_a * sin_b;
  return {c, cos_a * sin_b - sin_a * cos_b, -c};
}

WHIRL_TWIN_INLINE double cosOfDifference(double a, double b) {
  return cosOfDifferenceJet(a, b).value;
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

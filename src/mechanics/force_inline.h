// Inlining is what makes derived equations of motion as fast as hand-written ones: with every dual
// operation visible the compiler deletes the terms whose seeds are literal zeros. Loops over the
// directions hide them from it until too late: they are written out instead. Components of duals
// are plain arrays: the subscripts of std::array are calls, thousands in a step, and the compiler
// weighs for each whether to inline it, which takes longer than all else.
// Where the equations are long and their terms all alive (a bearing's film, a spin that is a state)
// that would take minutes and gigabytes to compile and bring nothing: their translation units
// define WHIRL_TWIN_LONG_EQUATIONS and leave inlining to the compiler.
#pragma once

#include <cstddef>
#include <type_traits>
#include <utility>

#ifdef WHIRL_TWIN_LONG_EQUATIONS
#define WHIRL_TWIN_INLINE inline
#define WHIRL_TWIN_FLAT
#else
#define WHIRL_TWIN_INLINE inline __attribute__((always_inline))
#define WHIRL_TWIN_FLAT __attribute__((always_inline))
#endif

namespace whirl_twin {

template <class F, std::size_t... i>
WHIRL_TWIN_INLINE void unrolled(const F& f, std::index_sequence<i...>) {
  (f(std::integral_constant<std::size_t, i>{}), ...);
}

/// f(0), f(1) ... f(n - 1), each index a constant; f is a lambda marked WHIRL_TWIN_FLAT.
template <std::size_t n, class F>
WHIRL_TWIN_INLINE void unrolled(const F& f) {
  unrolled(f, std::make_index_sequence<n>{});
}

}  // namespace whirl_twin

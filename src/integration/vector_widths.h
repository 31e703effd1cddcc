// One piece of code, compiled for several widths of vector: the machine's widest is taken, and the
// build still runs on any x86-64. The width is the machine's own: vectors that are wider compilers
// take in parts, through memory, which is slower than none.
#pragma once

#include <type_traits>

#include "mechanics/force_inline.h"

namespace whirl_twin {

/// Doubles side by side.
template <int lanes>
struct Vector {
  typedef double Type __attribute__((vector_size(8 * lanes), may_alias));
  /// Wherever they lie.
  typedef double Anywhere __attribute__((vector_size(8 * lanes), aligned(8), may_alias));
};

#if defined(__x86_64__) && !defined(__clang__)
template <class Body>
[[gnu::noinline, gnu::target("avx2,fma")]] void inFours(const Body& body) noexcept {
  body(std::integral_constant<int, 4>{});
}
template <class Body>
[[gnu::noinline, gnu::target("avx512f")]] void inEights(const Body& body) noexcept {
  body(std::integral_constant<int, 8>{});
}
/// By what it can do and not by its name: "haswell" is one of Intel's and no other.
inline const int kLanesHere =
    __builtin_cpu_supports("avx512f") != 0                                      ? 8
    : __builtin_cpu_supports("avx2") != 0 && __builtin_cpu_supports("fma") != 0 ? 4
                                                                                : 2;
#endif

/// body(lanes), a lambda marked WHIRL_TWIN_FLAT whose argument is an integral constant.
template <class Body>
void inWidestVectors(const Body& body) noexcept {
#if defined(__x86_64__) && !defined(__clang__)
  if (kLanesHere == 8) {
    inEights(body);
    return;
  }
  if (kLanesHere == 4) {
    inFours(body);
    return;
  }
#endif
  body(std::integral_constant<int, 2>{});
}

}  // namespace whirl_twin

// SIMD code compiled for several vector widths: the widest of the processor is selected at run
// time, so that a build runs on any x86-64. Vectors wider than the registers are avoided: compilers
// split them through memory, which is slower than scalar code.
#pragma once

#include <array>
#include <cstddef>
#include <type_traits>

#include "mechanics/force_inline.h"

namespace whirl_twin {

/// A vector of doubles.
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

// The values of n coordinates, for the sums of a step. Two are a vector register: stored one by one
// and loaded as a pair, as compilers do with an array, they would be late by as much as the
// equations take.

template <std::size_t n>
class SimdVector {
 public:
  SimdVector() = default;
  WHIRL_TWIN_INLINE explicit SimdVector(const std::array<double, n>& x) : x_(x) {}
  WHIRL_TWIN_INLINE const std::array<double, n>& array() const { return x_; }
  WHIRL_TWIN_INLINE void add(double factor, const SimdVector& other) {
    for (std::size_t i = 0; i < n; ++i) {
      x_[i] += factor * other.x_[i];
    }
  }
  WHIRL_TWIN_INLINE SimdVector operator+(const SimdVector& other) const {
    SimdVector sum = *this;
    for (std::size_t i = 0; i < n; ++i) {
      sum.x_[i] += other.x_[i];
    }
    return sum;
  }
  WHIRL_TWIN_INLINE SimdVector operator-(const SimdVector& other) const {
    SimdVector rest = *this;
    for (std::size_t i = 0; i < n; ++i) {
      rest.x_[i] -= other.x_[i];
    }
    return rest;
  }

 private:
  std::array<double, n> x_;
};

template <>
class SimdVector<2> {
 public:
  SimdVector() = default;
  WHIRL_TWIN_INLINE explicit SimdVector(const std::array<double, 2>& x) : x_{x[0], x[1]} {}
  WHIRL_TWIN_INLINE std::array<double, 2> array() const { return {x_[0], x_[1]}; }
  WHIRL_TWIN_INLINE void add(double factor, const SimdVector& other) { x_ += factor * other.x_; }
  WHIRL_TWIN_INLINE SimdVector operator+(const SimdVector& other) const {
    SimdVector sum;
    sum.x_ = x_ + other.x_;
    return sum;
  }
  WHIRL_TWIN_INLINE SimdVector operator-(const SimdVector& other) const {
    SimdVector rest;
    rest.x_ = x_ - other.x_;
    return rest;
  }

 private:
  using Pair = double __attribute__((vector_size(16)));
  Pair x_;
};

// Four doubles side by side: in one vector or in two, as the processor has it.

template <int lanes>
struct DoublesSideBySide;
template <>
struct DoublesSideBySide<2> {
  typedef double Type __attribute__((vector_size(16)));
  typedef double InMemory __attribute__((vector_size(16), aligned(8), may_alias));
};
template <>
struct DoublesSideBySide<4> {
  typedef double Type __attribute__((vector_size(32)));
  typedef double InMemory __attribute__((vector_size(32), aligned(8), may_alias));
};

template <int lanes>
struct FourDoubles {
  using Part = typename DoublesSideBySide<lanes>::Type;
  using InMemory = typename DoublesSideBySide<lanes>::InMemory;
  static constexpr int kParts = 4 / lanes;

  Part part[kParts];

  static WHIRL_TWIN_INLINE FourDoubles load(const double* from) {
    FourDoubles x;
    for (int i = 0; i < kParts; ++i) {
      x.part[i] = reinterpret_cast<const InMemory*>(from)[i];
    }
    return x;
  }
  /// The first two and the last two in each other's place.
  WHIRL_TWIN_INLINE FourDoubles halvesSwapped() const {
    if constexpr (lanes == 4) {
      return {{Part{part[0][2], part[0][3], part[0][0], part[0][1]}}};
    } else {
      return {{part[1], part[0]}};
    }
  }
  /// The first and the second in each other's place, the third and the fourth.
  WHIRL_TWIN_INLINE FourDoubles across() const {
    FourDoubles x;
    for (int i = 0; i < kParts; ++i) {
      if constexpr (lanes == 4) {
        x.part[i] = Part{part[i][1], part[i][0], part[i][3], part[i][2]};
      } else {
        x.part[i] = Part{part[i][1], part[i][0]};
      }
    }
    return x;
  }
  WHIRL_TWIN_INLINE void store(double* to) const {
    for (int i = 0; i < kParts; ++i) {
      reinterpret_cast<InMemory*>(to)[i] = part[i];
    }
  }
  WHIRL_TWIN_INLINE double sum() const {
    if constexpr (lanes == 4) {
      return (part[0][0] + part[0][2]) + (part[0][1] + part[0][3]);
    } else {
      const Part both = part[0] + part[1];
      return both[0] + both[1];
    }
  }
};

#define WHIRL_TWIN_OF_FOUR(operation)                                                    \
  template <int lanes>                                                                   \
  WHIRL_TWIN_INLINE FourDoubles<lanes> operator operation(const FourDoubles<lanes>& a,   \
                                                          const FourDoubles<lanes>& b) { \
    FourDoubles<lanes> x;                                                                \
    for (int i = 0; i < FourDoubles<lanes>::kParts; ++i) {                               \
      x.part[i] = a.part[i] operation b.part[i];                                         \
    }                                                                                    \
    return x;                                                                            \
  }
WHIRL_TWIN_OF_FOUR(+)
WHIRL_TWIN_OF_FOUR(-)
WHIRL_TWIN_OF_FOUR(*)
#undef WHIRL_TWIN_OF_FOUR

}  // namespace whirl_twin

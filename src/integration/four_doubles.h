// Four doubles side by side: in one vector or in two, as the processor has it.
#pragma once

#include "mechanics/force_inline.h"

namespace whirl_twin {

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

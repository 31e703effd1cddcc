// Weighted sums over the accelerations of the last steps: what a step of stoermer.h is made of.
// Of one or two coordinates four doubles are summed side by side, of four nodes or of two; of more,
// one node after the other.
#pragma once

#include <array>
#include <cstddef>

#include "integration/four_doubles.h"
#include "integration/lanes.h"
#include "integration/stoermer_weights.h"
#include "mechanics/force_inline.h"

namespace whirl_twin {

/// The weights of nodes of n values, one for each value where they are summed side by side.
template <std::size_t n>
class NodeWeights {
 public:
  static constexpr std::size_t kRepeated = n == 2 ? 2 : 1;

  void set(std::size_t node, double weight) {
    for (std::size_t i = 0; i < kRepeated; ++i) {
      weights_[kRepeated * node + i] = weight;
    }
  }
  WHIRL_TWIN_INLINE double operator[](std::size_t node) const { return weights_[kRepeated * node]; }
  WHIRL_TWIN_INLINE const double* from(std::size_t node) const {
    return &weights_[kRepeated * node];
  }

 private:
  std::array<double, kRepeated * stoermer::kMostNodes> weights_{};
};

/// What four doubles side by side are for one value and for two.
template <class Part>
WHIRL_TWIN_INLINE Lanes<1> folded(const Part& fours, Lanes<1>) {
  return Lanes<1>({(fours[0] + fours[2]) + (fours[1] + fours[3])});
}
template <class Part>
WHIRL_TWIN_INLINE Lanes<2> folded(const Part& fours, Lanes<2>) {
  return Lanes<2>({fours[0], fours[1]}) + Lanes<2>({fours[2], fours[3]});
}

/// The sum of weight[k + 1] past[k] over `nodes` of the past, the latest first: that of the node
/// that is yet to come, 0, is left out. The latest has just been stored: it would be late as a part
/// of a longer vector.
template <std::size_t nodes, std::size_t n>
WHIRL_TWIN_INLINE Lanes<n> sumOfPast(const NodeWeights<n>& weights, const Lanes<n>* past) {
  if constexpr (n <= 2) {
    static_assert(sizeof(Lanes<n>) == n * sizeof(double));
    constexpr std::size_t kSideBySide = 4 / n;
    constexpr std::size_t kVectors = (nodes - 1) / kSideBySide;
    constexpr std::size_t kAlone = nodes - kSideBySide * kVectors;
    typename FourDoubles<4>::Part fours{};
    for (std::size_t k = kAlone; k < nodes; k += kSideBySide) {
      fours += FourDoubles<4>::load(weights.from(k + 1)).part[0] *
               FourDoubles<4>::load(reinterpret_cast<const double*>(past + k)).part[0];
    }
    Lanes<n> sum = folded(fours, Lanes<n>());
    for (std::size_t k = kAlone; k > 0; --k) {
      sum.add(weights[k], past[k - 1]);
    }
    return sum;
  } else {
    Lanes<n> sum{};
    unrolled<nodes>([&](auto from_last) WHIRL_TWIN_FLAT {
      constexpr std::size_t k = nodes - decltype(from_last)::value;
      sum.add(weights[k], past[k - 1]);
    });
    return sum;
  }
}

}  // namespace whirl_twin

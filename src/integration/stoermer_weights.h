// The weights of Stoermer-Cowell steps (stoermer.h): with p(s) the polynomial through accelerations
// at equidistant nodes, s in steps from the last state and d(n) = q(n) - q(n - 1),
//
//   position    d(n + 1) = d(n) + h^2 int_0^1 (1 - s) (p(s) + p(-s)) ds
//   rate        v(n + 1) = d(n + 1) / h + h int_0^1 s p(s) ds
//   work        int_0^1 p(s) ds h, of powers
//   backwards   d(n) = h v(n) - h^2 int_0^1 (1 - s) p(-s) ds
//
// Each integral is a sum over the nodes (Hairer, Norsett & Wanner, Solving Ordinary Differential
// Equations I, III.10; the rates as of Adams, ibid. III.1). A predictor's nodes are 0, -1, -2 ...,
// a corrector's 1, 0, -1 ...
//
// Dense output: within a step, at a fraction x of it, the deviation from the straight line from
// q(0) to q(1) is the deflection of a beam under p, zero at both ends:
//
//   q(x) = q(1) - (1 - x) d(1) + h^2 int_0^x (x - s) p(s) ds - h^2 x int_0^1 (1 - s) p(s) ds
#pragma once

#include <array>
#include <cstddef>

#include "integration/simd_vector.h"
#include "mechanics/force_inline.h"

namespace whirl_twin {

namespace stoermer {

/// Maximum number of accelerations in a step, and in its error estimate.
inline constexpr std::size_t kMaxTerms = 12;
inline constexpr std::size_t kMaxStoermerNodes = kMaxTerms + 1;

/// One for each node, the latest first; 0 beyond the terms of a scheme.
using Weights = std::array<double, kMaxStoermerNodes>;

/// Of the integral over s^i, i = 0, 1, 2 ...
using Moments = std::array<long double, kMaxStoermerNodes>;

/// The Lagrange polynomials of the nodes first, first - 1, ..., by their coefficients of 1, s, s^2
/// ...: computed once for all integrals over them, as compilers limit the cost of constant
/// expressions.
struct LagrangePolynomials {
  constexpr LagrangePolynomials(std::size_t nodes, int first) : terms(nodes) {
    for (std::size_t j = 0; j < nodes; ++j) {
      std::array<long double, kMaxStoermerNodes + 1>& polynomial = coefficients[j];
      polynomial[0] = 1.0L;
      for (std::size_t k = 0; k < nodes; ++k) {
        if (k == j) {
          continue;
        }
        const long double node = first - static_cast<long double>(k);
        for (std::size_t i = nodes; i > 0; --i) {
          polynomial[i] = polynomial[i - 1] - node * polynomial[i];
        }
        polynomial[0] *= -node;
        denominators[j] *= static_cast<long double>(k) - static_cast<long double>(j);
      }
    }
  }

  std::size_t terms;
  std::array<std::array<long double, kMaxStoermerNodes + 1>, kMaxStoermerNodes>
      coefficients{};  ///< whole numbers below 2^53,
  std::array<long double, kMaxStoermerNodes> denominators{
      1.0L, 1.0L, 1.0L, 1.0L, 1.0L, 1.0L, 1.0L,
      1.0L, 1.0L, 1.0L, 1.0L, 1.0L, 1.0L};  ///< to be divided by these
};

/// Weights at the nodes with these moments: integrals of their Lagrange polynomials.
constexpr Weights weights(const LagrangePolynomials& lagrange, const Moments& moments) {
  Weights result{};
  for (std::size_t j = 0; j < lagrange.terms; ++j) {
    long double integral = 0.0L;
    for (std::size_t i = 0; i < lagrange.terms; ++i) {
      integral += lagrange.coefficients[j][i] * moments[i];
    }
    result[j] = static_cast<double>(integral / lagrange.denominators[j]);
  }
  return result;
}

constexpr Moments positionMoments() {
  Moments m{};
  for (std::size_t i = 0; i < kMaxStoermerNodes; i += 2) {
    m[i] = 2.0L / static_cast<long double>((i + 1) * (i + 2));
  }
  return m;
}
constexpr Moments backwardsMoments() {
  Moments m{};
  for (std::size_t i = 0; i < kMaxStoermerNodes; ++i) {
    m[i] = (i % 2 == 0 ? 1.0L : -1.0L) / static_cast<long double>((i + 1) * (i + 2));
  }
  return m;
}
/// Of s^power p(s) over the step.
constexpr Moments stepMoments(std::size_t power) {
  Moments m{};
  for (std::size_t i = 0; i < kMaxStoermerNodes; ++i) {
    m[i] = 1.0L / static_cast<long double>(i + power + 1);
  }
  return m;
}

/// Of the polynomial with one more node, minus those of a scheme with `terms` terms.
constexpr Weights errorWeights(std::size_t terms, bool corrected) {
  Weights error = weights({terms + 1, 1}, positionMoments());
  const Weights own = weights({terms, corrected ? 1 : 0}, positionMoments());
  for (std::size_t k = 0; k < terms; ++k) {
    error[corrected ? k : k + 1] -= own[k];
  }
  return error;
}

/// The coefficients of p: of 1, s, s^2 ...
constexpr std::array<Weights, kMaxTerms> polynomial(const LagrangePolynomials& lagrange) {
  std::array<Weights, kMaxTerms> all{};
  for (std::size_t i = 0; i < lagrange.terms; ++i) {
    for (std::size_t j = 0; j < lagrange.terms; ++j) {
      all[i][j] = static_cast<double>(lagrange.coefficients[j][i] / lagrange.denominators[j]);
    }
  }
  return all;
}

}  // namespace stoermer

/// A method of the family.
struct StoermerScheme {
  const char* name;   ///< as in scene files
  std::size_t terms;  ///< accelerations in its history
  bool corrected;     ///< and evaluated again where the correction leads
  bool ahead;         ///< steps of the twin are interpolated within one of its own
  stoermer::Weights position, rate;
  stoermer::Weights corrected_position, corrected_rate;
  stoermer::Weights work, backwards;
  stoermer::Weights error;  ///< of a position, at the nodes 1, 0, -1 ...
  std::array<stoermer::Weights, stoermer::kMaxTerms> polynomial;  ///< coefficients of p, likewise
};

constexpr StoermerScheme stoermerScheme(const char* name, std::size_t terms, bool corrected,
                                        bool ahead = false) {
  using namespace stoermer;
  const LagrangePolynomials predicting(terms, 0), correcting(terms, 1);
  return {name,
          terms,
          corrected,
          ahead,
          weights(predicting, positionMoments()),
          weights(predicting, stepMoments(1)),
          weights(correcting, positionMoments()),
          weights(correcting, stepMoments(1)),
          weights(correcting, stepMoments(0)),
          weights(predicting, backwardsMoments()),
          errorWeights(terms, corrected),
          stoermer::polynomial(correcting)};
}

inline constexpr std::array<StoermerScheme, 4> kStoermerSchemes{
    stoermerScheme("stoermer_6", 6, false), stoermerScheme("stoermer", 10, true),
    stoermerScheme("stoermer_ahead", 10, true, true), stoermerScheme("stoermer_12", 12, false)};

/// Dense output within a step, at a fraction of it: by the straight line, and weights at the nodes
/// 1, 0, -1 ...
struct DenseOutputWeights {
  DenseOutputWeights(const StoermerScheme& scheme, double at);

  double share;                      ///< [-], 0..1
  stoermer::Weights position, rate;  ///< times h^2, h
  stoermer::Weights work;            ///< times h, of powers: from there to the end of the step
};

// Weighted sums over the accelerations of the last steps: what a step of stoermer.h is made of.
// Of one or two coordinates four doubles are summed side by side, of four nodes or of two; of more,
// one node after the other.

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
  std::array<double, kRepeated * stoermer::kMaxStoermerNodes> weights_{};
};

/// What four doubles side by side are for one value and for two.
template <class Part>
WHIRL_TWIN_INLINE SimdVector<1> folded(const Part& fours, SimdVector<1>) {
  return SimdVector<1>({(fours[0] + fours[2]) + (fours[1] + fours[3])});
}
template <class Part>
WHIRL_TWIN_INLINE SimdVector<2> folded(const Part& fours, SimdVector<2>) {
  return SimdVector<2>({fours[0], fours[1]}) + SimdVector<2>({fours[2], fours[3]});
}

/// The sum of weight[k + 1] past[k] over `nodes` of the history, the latest first: the future node,
/// 0, is excluded. The latest has just been stored: loading it as part of a longer vector would
/// stall.
template <std::size_t nodes, std::size_t n>
WHIRL_TWIN_INLINE SimdVector<n> sumOfPast(const NodeWeights<n>& weights,
                                          const SimdVector<n>* past) {
  if constexpr (n <= 2) {
    static_assert(sizeof(SimdVector<n>) == n * sizeof(double));
    constexpr std::size_t kSideBySide = 4 / n;
    constexpr std::size_t kVectors = (nodes - 1) / kSideBySide;
    constexpr std::size_t kAlone = nodes - kSideBySide * kVectors;
    typename FourDoubles<4>::Part fours{};
    for (std::size_t k = kAlone; k < nodes; k += kSideBySide) {
      fours += FourDoubles<4>::load(weights.from(k + 1)).part[0] *
               FourDoubles<4>::load(reinterpret_cast<const double*>(past + k)).part[0];
    }
    SimdVector<n> sum = folded(fours, SimdVector<n>());
    for (std::size_t k = kAlone; k > 0; --k) {
      sum.add(weights[k], past[k - 1]);
    }
    return sum;
  } else {
    SimdVector<n> sum{};
    unrolled<nodes>([&](auto from_last) WHIRL_TWIN_FLAT {
      constexpr std::size_t k = nodes - decltype(from_last)::value;
      sum.add(weights[k], past[k - 1]);
    });
    return sum;
  }
}

}  // namespace whirl_twin

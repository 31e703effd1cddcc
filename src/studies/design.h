// Designs of experiments: the points of a study in the unit cube, and on grids. Point i is a
// function of the design, the seed and i alone, so that points can be computed on any machine, in
// any order.
//
//   grid               every combination of the levels, the last number varying fastest
//   list               entry i of every list
//   one_at_a_time      the nominal scene, then each number through its levels, the others nominal
//   monte_carlo        independent draws (Philox 4x32-10: Salmon et al., SC11)
//   latin_hypercube    each number once in each of n equal strata (McKay, Beckman & Conover,
//                      Technometrics 21, 1979); strata by a permutation of 0..n-1 that is a
//                      function of i (a Feistel network, repeated until it is below n)
//   sobol              Sobol' sequence from its first point on (Boost.Random, direction numbers of
//                      Joe & Kuo, SIAM J. Sci. Comput. 30, 2008), scrambled by the seed (Owen,
//                      Randomly permuted (t,m,s)-nets and (t,s)-sequences, 1995): of 2^k points
//                      one is in each of 2^k strata of every number
//   sobol_indices      for n base points of Sobol' sequences of 2 d dimensions, A and B:
//                      A, B, and A with number j from B for each j: n (d + 2) points (Saltelli et
//                      al., Comput. Phys. Comm. 181, 2010). Base point i is of replicate i modulo
//                      replicates(), each a sequence with a different scrambling
//   morris             trajectories of d + 1 points, with d steps of half the range, each in a
//                      different number (Morris, Technometrics 33, 1991), on levels in the
//                      middles of p equal parts, (k + 1/2) / p
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

namespace whirl_twin {

struct Design {
  enum class Kind {
    kGrid,
    kList,
    kOneAtATime,
    kMonteCarlo,
    kLatinHypercube,
    kSobol,
    kSobolIndices,
    kMorris
  };
  Kind kind = Kind::kMonteCarlo;
  std::uint64_t points = 0;
  std::uint64_t base = 0;           ///< n of sobol_indices, trajectories of morris
  std::size_t dimensions = 0;       ///< varied numbers
  std::vector<std::size_t> levels;  ///< of each number: grid, one_at_a_time; p of morris

  /// Its points are random draws from the distributions.
  bool drawn() const {
    return kind == Kind::kMonteCarlo || kind == Kind::kLatinHypercube || kind == Kind::kSobol;
  }
};

/// "latin_hypercube", …
const std::string& name(Design::Kind kind);
const std::vector<std::string>& designNames();

/// Quantiles of point i: for all designs but grid, list and one_at_a_time. [dimensions], 0 < u < 1.
std::vector<double> quantilesAt(const Design& design, std::uint32_t seed, std::uint64_t point);

/// Level of each number at point i: for grid, list and one_at_a_time. Empty: nominal value.
std::vector<std::optional<std::size_t>> levelsAt(const Design& design, std::uint64_t point);

/// Step k of a Morris trajectory: the number that changes from point k to point k + 1, and the sign
/// of the change.
struct MorrisStep {
  std::size_t number = 0;
  bool up = false;
};
std::vector<MorrisStep> morrisSteps(const Design& design, std::uint32_t seed,
                                    std::uint64_t trajectory);

/// Step of a number in the unit cube.
double morrisStride(const Design& design);

/// Image of `place` under a permutation of 0..count-1 that depends on the key.
std::uint64_t permuted(std::uint64_t place, std::uint64_t count, std::uint64_t key);

/// Point of a Sobol' sequence, 0 is the origin, scrambled by the seed and the number of a
/// replicate. [dimensions], 0 < u < 1.
std::vector<double> sobolPoint(std::size_t dimensions, std::uint64_t point, std::uint32_t seed,
                               std::uint32_t replicate = 0);
/// Number of independent replicates for n base points of sobol_indices: 2 to 16.
std::uint64_t replicates(std::uint64_t base);
/// Of a Sobol' sequence.
constexpr std::size_t kMaxSobolDimensions = 1000;

}  // namespace whirl_twin

// Which of the numbers that vary a measure hangs on, from the points of a design made for it.
//
// Sobol' indices: parts of the variance V of a measure f. With A, B and A_j (A with number j from
// B), n rows of each:
//   first order  S_j  = (1/n) sum f(B) (f(A_j) - f(A)) / V          (Saltelli et al. 2010, table 2)
//   total        ST_j = (1/2n) sum (f(A) - f(A_j))^2 / V            (Jansen 1999)
// S_j is what number j does alone, ST_j what it does alone and with others; V is that of f(A) and
// f(B) together, and f is taken from its mean, which the first sum's rounding and error hang on.
//
// Morris: elementary effects (f(u + stride e_j) - f(u)) / stride of number j, per whole range of
// it: their mean, the mean of their magnitudes (mu*, Campolongo, Cariboni & Saltelli 2007) and
// their standard deviation, which tells of curvature or of other numbers.
//
// Intervals: 95 %. Of Sobol' indices by the jackknife over the design's independent replicates and
// Student's distribution: rows of one sequence are no independent draws, and a bootstrap of them
// would be several times too wide. Of Morris's effects by 1000 bootstrap samples of trajectories,
// with a seed.
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "studies/design.h"

namespace whirl_twin {

/// With a 95 % interval; NaN where there is none: all values are one, or too few are known.
struct Estimate {
  double value = 0.0;
  double low = 0.0;
  double high = 0.0;
};

struct SobolIndices {
  std::vector<Estimate> first, total;  ///< of each number
  std::uint64_t rows = 0;              ///< all of whose points are known
  std::uint64_t left_out = 0;
};

struct MorrisEffects {
  std::vector<Estimate> mean, mean_magnitude, deviation;  ///< of each number
  std::uint64_t trajectories = 0;                         ///< all of whose points are known
  std::uint64_t left_out = 0;
};

/// Of a measure at every point of the design; what is not finite is not known.
SobolIndices sobolIndices(const Design& design, const std::vector<double>& measure);
MorrisEffects morrisEffects(const Design& design, std::uint32_t seed,
                            const std::vector<double>& measure);

}  // namespace whirl_twin

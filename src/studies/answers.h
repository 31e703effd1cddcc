// What a study's points say together: how each measure is distributed, how many of the points meet
// what is required, and which of the numbers it hangs on.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "studies/design.h"
#include "studies/result_folder.h"
#include "studies/study.h"

namespace whirl_twin {

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

inline constexpr std::array<double, 7> kPercentiles{1.0, 5.0, 25.0, 50.0, 75.0, 95.0, 99.0};

/// How a measure is distributed over the points where it is finite; NaN where it is nowhere.
struct Distributed {
  std::uint64_t count = 0;      ///< finite
  std::uint64_t undefined = 0;  ///< infinite or not a number, of points that did not fail
  double mean = 0.0, deviation = 0.0;
  double smallest = 0.0, largest = 0.0;
  /// Linear between the values in their order (Hyndman & Fan's type 7).
  std::array<double, kPercentiles.size()> percentiles{};
  /// 95 % intervals of them, as of independent draws: between order statistics whose ranks a
  /// binomial distribution gives (Hahn & Meeker, Statistical Intervals, 1991, section 5.2). Empty
  /// where the points are no draws (grid, list, one_at_a_time, morris), infinite where the draws
  /// are too few to bound the percentile on that side. Of latin_hypercube and sobol, whose points
  /// are spread more evenly, they are wider than need be.
  std::vector<std::array<double, 2>> intervals;
};
Distributed distributed(const std::vector<double>& values, const std::vector<bool>& failed,
                        bool drawn = true);

/// Of all points: one that failed, and a measure that is not a number, meet nothing.
struct Yield {
  std::uint64_t passed = 0;
  std::uint64_t of = 0;
  /// 95 % interval of the part that passes, as of independent draws (Wilson 1927).
  double low = 0.0, high = 0.0;
  double part() const { return static_cast<double>(passed) / static_cast<double>(of); }
};
Yield yieldOf(std::uint64_t passed, std::uint64_t of);

struct Answers {
  std::uint64_t points = 0;
  std::uint64_t failures = 0;
  std::vector<Distributed> measures;  ///< in the study's order
  std::vector<Yield> requirements;    ///< each alone
  std::optional<Yield> yield;         ///< of all together; nothing where nothing is required
  std::vector<SobolIndices> sobol;    ///< of each measure; of a design for them
  std::vector<MorrisEffects> morris;  ///< likewise
};
Answers answersOf(const Study& study, const StudyTable& table);

}  // namespace whirl_twin

// Statistics of the points of a study: the distribution of each measure, the yield of the
// requirements, and the sensitivity to the varied numbers.
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

// Sensitivity of a measure to the varied numbers, from the points of a design for this purpose.
//
// Sobol' indices: fractions of the variance V of a measure f. With A, B and A_j (A with number j
// from B), n rows of each:
//   first order  S_j  = (1/n) sum f(B) (f(A_j) - f(A)) / V          (Saltelli et al. 2010, table 2)
//   total        ST_j = (1/2n) sum (f(A) - f(A_j))^2 / V            (Jansen 1999)
// S_j is the effect of number j alone, ST_j includes its interactions; V is that of f(A) and f(B)
// together. The mean is subtracted from f, since it affects rounding and error of the first sum.
//
// Morris: elementary effects (f(u + stride e_j) - f(u)) / stride of number j, relative to its whole
// range: their mean, the mean of their magnitudes (mu*, Campolongo, Cariboni & Saltelli 2007) and
// their standard deviation, which shows curvature or interactions.
//
// Intervals: 95 %. For Sobol' indices by the jackknife over the design's independent replicates and
// Student's distribution: rows of a sequence are not independent, and a bootstrap of them would be
// several times too wide. For Morris's effects by 1000 bootstrap samples of trajectories, with a
// seed.

/// With a 95 % interval; NaN if undefined: all values are equal, or too few are known.
struct Estimate {
  double value = 0.0;
  double low = 0.0;
  double high = 0.0;
};

struct SobolIndices {
  std::vector<Estimate> first, total;  ///< of each number
  std::uint64_t rows = 0;              ///< with all points known
  std::uint64_t left_out = 0;
};

struct MorrisEffects {
  std::vector<Estimate> mean, mean_magnitude, deviation;  ///< of each number
  std::uint64_t trajectories = 0;                         ///< with all points known
  std::uint64_t left_out = 0;
};

/// From a measure at every point of the design; values that are not finite count as unknown.
SobolIndices sobolIndices(const Design& design, const std::vector<double>& measure);
MorrisEffects morrisEffects(const Design& design, std::uint32_t seed,
                            const std::vector<double>& measure);

inline constexpr std::array<double, 7> kPercentiles{1.0, 5.0, 25.0, 50.0, 75.0, 95.0, 99.0};

/// Distribution of a measure over the points where it is finite; NaN if there are none.
struct Distributed {
  std::uint64_t count = 0;      ///< finite
  std::uint64_t undefined = 0;  ///< infinite or NaN, of points that did not fail
  double mean = 0.0, deviation = 0.0;
  double smallest = 0.0, largest = 0.0;
  /// Linear interpolation between order statistics (Hyndman & Fan's type 7).
  std::array<double, kPercentiles.size()> percentiles{};
  /// Their 95 % intervals for independent draws: between order statistics with ranks from a
  /// binomial distribution (Hahn & Meeker, Statistical Intervals, 1991, section 5.2). Empty if the
  /// points are not random (grid, list, one_at_a_time, morris), infinite if there are too few draws
  /// to bound the percentile on that side. For latin_hypercube and sobol, whose points are more
  /// uniform, they are wider than necessary.
  std::vector<std::array<double, 2>> intervals;
};
Distributed distributed(const std::vector<double>& values, const std::vector<bool>& failed,
                        bool drawn = true);

/// Of all points: failed points, and NaN measures, do not pass.
struct Yield {
  std::uint64_t passed = 0;
  std::uint64_t of = 0;
  /// 95 % interval of the fraction that passes, for independent draws (Wilson 1927).
  double low = 0.0, high = 0.0;
  double part() const { return static_cast<double>(passed) / static_cast<double>(of); }
};
Yield yieldOf(std::uint64_t passed, std::uint64_t of);

struct Answers {
  std::uint64_t points = 0;
  std::uint64_t failures = 0;
  std::vector<Distributed> measures;  ///< in the study's order
  std::vector<Yield> requirements;    ///< each alone
  std::optional<Yield> yield;         ///< of all together; empty without requirements
  std::vector<SobolIndices> sobol;    ///< of each measure; if the design is for them
  std::vector<MorrisEffects> morris;  ///< likewise
};
Answers answersOf(const Study& study, const StudyTable& table);

}  // namespace whirl_twin

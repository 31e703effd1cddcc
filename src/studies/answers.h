// What a study's points say together: how each measure is distributed, how many of the points meet
// what is required, and which of the numbers it hangs on.
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "studies/result_folder.h"
#include "studies/sensitivity.h"
#include "studies/study.h"

namespace whirl_twin {

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

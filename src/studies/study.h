// A study as it was asked for: which numbers of a scene vary, by which design, what is run,
// measured and required. Made by readStudy() only.
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "monitoring/alarm_settings.h"
#include "studies/design.h"
#include "studies/expression.h"
#include "studies/scene_numbers.h"

namespace whirl_twin {

// How one number varies over the points of a study, by its quantiles: value(u) is the number below
// which a part u of the distribution lies, so that a design of points in the unit cube is one of
// values. A list has its entries, all alike likely, in the order given.

struct Distribution {
  enum class Kind { kUniform, kLogUniform, kNormal, kList };
  Kind kind = Kind::kUniform;
  double low = 0.0;               ///< uniform, log-uniform
  double high = 0.0;              ///< likewise; log-uniform: 0 < low < high
  double mean = 0.0;              ///< normal
  double deviation = 0.0;         ///< normal, > 0
  std::vector<double> list = {};  ///< not empty

  /// u: 0 < u < 1; for all but a normal distribution also 0 and 1.
  double value(double u) const;
  /// Value k of n that stand for it on a grid: those of a list; evenly from end to end of an
  /// interval (of its logarithms), the middle for n = 1; the quantiles (k + 1/2) / n of a normal
  /// distribution. n > 0, k < n.
  double level(std::size_t k, std::size_t n) const;
  /// How many levels there are where n are asked for: a list has its own number.
  std::size_t levels(std::size_t n) const;
  /// The smallest and largest number that can come, infinite for a normal distribution.
  double smallest() const;
  double largest() const;
};

/// A number of the scene that varies.
struct Variation {
  std::string path;                 ///< as the study has it: `rotor.bearings[0].kxx`
  std::vector<SceneNumber> places;  ///< of the scene's file, all of which get the value
  Distribution distribution;
  std::string unit;      ///< "-" without or where it is not known
  double nominal = 0.0;  ///< what the scene gives
};

struct Measure {
  std::string name;
  std::string text;  ///< of the expression, as the study has it
  Expression expression;
  std::string unit = "-";  ///< "-" without, and of what is computed of several
};

/// What a measure must be for a point to pass.
struct Requirement {
  enum class Is { kBelow, kAtMost, kAbove, kAtLeast };
  std::size_t measure = 0;  ///< place among the measures
  Is is = Is::kBelow;
  double limit = 0.0;

  /// False for what is not a number.
  bool holds(double value) const {
    switch (is) {
      case Is::kBelow:
        return value < limit;
      case Is::kAtMost:
        return value <= limit;
      case Is::kAbove:
        return value > limit;
      default:
        return value >= limit;
    }
  }
};

/// What is looked for in place of a design: where a measure is least, or greatest.
struct Optimization {
  std::size_t measure = 0;  ///< place among the measures
  bool maximize = false;
  std::vector<std::size_t> over;  ///< places of the numbers that are sought, among `vary`
  std::string method;             ///< bobyqa, cobyla, crs or isres
  std::uint64_t evaluations = 0;  ///< at most
  double tolerance = 0.0;         ///< [-], of each range: steps that are too small to matter
};

struct Study {
  std::string source;      ///< the study's file
  std::string text;        ///< its bytes
  std::string scene_path;  ///< of the scene's file
  std::string scene_text;  ///< its bytes
  std::uint64_t hash = 0;  ///< of both texts, and of the monitor's settings
  std::uint32_t seed = 1;
  std::uint64_t block = 1;  ///< points that are run, and written, together
  bool stop_at_failure = false;
  std::vector<Variation> vary;
  Design design;
  std::optional<double> duration;  ///< [s], simulated; nothing: no run
  std::optional<double> speed;     ///< [rad/s], of the shafts in analyses; nothing: at the start
  AlarmSettings alarms;            ///< of the monitor, for alarms that are measured
  std::vector<Measure> measures;
  std::vector<Requirement> requirements;
  std::optional<Optimization> optimization;  ///< in place of a design: there are no points then

  std::uint64_t points() const { return design.points; }
  std::uint64_t blocks() const { return (points() + block - 1) / block; }
  /// Points of a block: from its first to one before the next one's.
  std::uint64_t firstOf(std::uint64_t number) const { return number * block; }
  std::uint64_t sizeOf(std::uint64_t number) const {
    return std::min(block, points() - firstOf(number));
  }
  /// The values of point i, in the order of `vary`: of the study and i alone.
  std::vector<double> valuesAt(std::uint64_t point) const;
};

/// "peak < 0.0002"
std::string text(const Requirement& requirement, const Study& study);

}  // namespace whirl_twin

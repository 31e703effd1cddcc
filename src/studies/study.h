// A study: which numbers of a scene vary, by which design, what is run, measured and required. Made
// by readStudy() only.
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

// Distribution of a number over the points of a study, by its quantile function: value(u) is the
// number with the cumulative probability u, which maps a design in the unit cube to values. The
// entries of a list are equally likely, in the given order.

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
  /// Value k of n on a grid: the entries of a list; equidistant from end to end of an interval (of
  /// its logarithms), the middle for n = 1; the quantiles (k + 1/2) / n of a normal distribution. n
  /// > 0, k < n.
  double level(std::size_t k, std::size_t n) const;
  /// Number of levels if n are requested: a list has a fixed number.
  std::size_t levels(std::size_t n) const;
  /// Smallest and largest possible value, infinite for a normal distribution.
  double smallest() const;
  double largest() const;
};

/// A varied number of the scene.
struct Variation {
  std::string path;                 ///< as in the study: `rotor.bearings[0].kxx`
  std::vector<SceneNumber> places;  ///< in the scene's file; all get the value
  Distribution distribution;
  std::string unit;      ///< "-" if dimensionless or not known
  double nominal = 0.0;  ///< value in the scene
  /// Written behind the value in the scene's file, whose reader converts it; "": the number is in
  /// the unit of the scene.
  std::string written_unit = "";
};

struct Measure {
  std::string name;
  std::string text;  ///< of the expression, as in the study
  Expression expression;
  std::string unit = "-";  ///< "-" if dimensionless, and for compound expressions
};

/// Requirement on a measure for a point to pass.
struct Requirement {
  enum class Is { kBelow, kAtMost, kAbove, kAtLeast };
  std::size_t measure = 0;  ///< index of the measure
  Is is = Is::kBelow;
  double limit = 0.0;

  /// False for NaN.
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

/// Optimization in place of a design: minimizes or maximizes a measure.
struct Optimization {
  std::size_t measure = 0;  ///< index of the measure
  bool maximize = false;
  std::vector<std::size_t> over;  ///< indices among `vary` of the numbers to find
  std::string method;             ///< bobyqa, cobyla, crs or isres
  std::uint64_t evaluations = 0;  ///< maximum
  double tolerance = 0.0;         ///< [-], of each range: termination by step size
};

struct Study {
  std::string source;      ///< the study's file
  std::string text;        ///< its bytes
  std::string scene_path;  ///< of the scene's file
  std::string scene_text;  ///< its bytes
  std::uint64_t hash = 0;  ///< of both texts and the monitor's settings
  std::uint32_t seed = 1;
  std::uint64_t block = 1;  ///< points run and written together
  bool stop_at_failure = false;
  std::vector<Variation> vary;
  Design design;
  std::optional<double> duration;  ///< [s], simulated; empty: no run
  std::optional<double> speed;     ///< [rad/s], of the shafts in analyses; empty: initial
  AlarmSettings alarms;            ///< settings of the monitor, for measured alarms
  std::vector<Measure> measures;
  std::vector<Requirement> requirements;
  std::optional<Optimization> optimization;  ///< in place of a design: without points

  std::uint64_t points() const { return design.points; }
  std::uint64_t blocks() const { return (points() + block - 1) / block; }
  /// Points of a block: from its first one to the one before the next block's.
  std::uint64_t firstOf(std::uint64_t number) const { return number * block; }
  std::uint64_t sizeOf(std::uint64_t number) const {
    return std::min(block, points() - firstOf(number));
  }
  /// The values of point i, in the order of `vary`; depend on the study and i only.
  std::vector<double> valuesAt(std::uint64_t point) const;
};

/// "peak < 0.0002"
std::string text(const Requirement& requirement, const Study& study);

}  // namespace whirl_twin

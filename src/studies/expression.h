// What a study measures, as it is written: a small expression over what a run publishes and what
// linear theory says.
//
//   max(rotor.whirl.radius) / 2.0e-4            a run's quantity comes as one number of it
//   critical_speeds[0] - 300                    of the analysis, and numbers that vary, as they are
//   settling(swing.theta, 0.05)                 within 5 % of the largest deviation from its end
//
//   expression = term {(+|-) term}; term = factor {(*|/) factor}; factor = [-] power
//   power = primary [^ factor]; primary = number | (expression) | path | name(path [, number])
//         | (abs|sqrt|log)(expression)
#pragma once

#include <cstddef>
#include <string>
#include <vector>

namespace whirl_twin {

/// A number that an expression stands on.
struct ExpressionLeaf {
  std::string reduction;  ///< of a run: max, rms, …; "": the number of that path itself
  std::string path;       ///< `rotor.whirl.radius`, `critical_speeds[0]`
  double argument = 0.0;  ///< of settling
};

class Expression {
 public:
  /// Throws Refusal: "must be …, found … at character 5".
  explicit Expression(const std::string& text);

  const std::vector<ExpressionLeaf>& leaves() const { return leaves_; }
  /// It is one number as it is: nothing is done with it.
  bool isLeaf() const { return steps_.size() == 1 && leaves_.size() == 1; }
  /// With the value of each leaf.
  double value(const std::vector<double>& leaves) const;

 private:
  friend class ExpressionParser;
  enum class Operation {
    kNumber,
    kLeaf,
    kAdd,
    kSubtract,
    kMultiply,
    kDivide,
    kPower,
    kNegate,
    kAbs,
    kSqrt,
    kLog
  };
  struct Step {
    Operation operation;
    double number = 0.0;
    std::size_t leaf = 0;
  };

  std::vector<Step> steps_;  // operands before their operation
  std::vector<ExpressionLeaf> leaves_;
};

/// max, min, mean, rms, peak, range, standard_deviation, initial, final, time_of_max, settling.
const std::vector<std::string>& reductionNames();

/// A quantity of a run as one number, while it goes by.
class Reduction {
 public:
  Reduction(const std::string& name, double argument);
  /// The next value, at a simulated time [s]; the first is that of the start.
  void take(double time, double value);
  /// NaN where there is none: a motion that is not within the band at its end does not settle.
  double result() const;

 private:
  enum class Kind {
    kMax,
    kMin,
    kMean,
    kRms,
    kPeak,
    kRange,
    kDeviation,
    kInitial,
    kFinal,
    kTimeOfMax,
    kSettling
  };
  double settling() const;

  Kind kind_;
  double argument_;
  std::size_t count_ = 0;
  double first_ = 0.0, last_ = 0.0, least_ = 0.0, most_ = 0.0, time_of_most_ = 0.0;
  double mean_ = 0.0, squares_ = 0.0;   // Welford's
  std::vector<double> times_, values_;  // of settling only
};

}  // namespace whirl_twin

// Expressions of a study's measures: over the quantities published by a run and the results of
// linear analyses.
//
//   max(rotor.whirl.radius) / 2.0e-4            quantities of a run are reduced to one number
//   critical_speeds[0] - 300                    results of analyses, and varied numbers
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

/// An operand of an expression.
struct ExpressionLeaf {
  std::string reduction;  ///< of a run: max, rms, …; "": the number of that path
  std::string path;       ///< `rotor.whirl.radius`, `critical_speeds[0]`
  double argument = 0.0;  ///< of settling
};

class Expression {
 public:
  /// Throws InputError: "must be …, found … at character 5".
  explicit Expression(const std::string& text);

  const std::vector<ExpressionLeaf>& leaves() const { return leaves_; }
  /// It is a single operand.
  bool isLeaf() const { return steps_.size() == 1 && leaves_.size() == 1; }
  /// With the values of the leaves.
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

/// Reduces a quantity of a run to one number, sample by sample.
class Reduction {
 public:
  Reduction(const std::string& name, double argument);
  /// The next value, at a simulated time [s]; the first is that of the start.
  void take(double time, double value);
  /// NaN if undefined: a motion that is outside the band until its end does not settle.
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

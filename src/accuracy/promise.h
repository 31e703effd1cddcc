// What can be promised of a way to step a system: its error over the horizon, and how long it keeps
// the tolerance, measured against a reference (reference_trajectory.h) from the scene's start.
//
// Nothing is extrapolated: beyond where the reference is known nothing is said. The one exception
// are exact steps of linear systems at constant speed, whose rounding grows no faster than the
// time.
#pragma once

#include <cstdint>

#include "accuracy/reference_trajectory.h"
#include "models/model_info.h"

namespace whirl_twin {

/// The method whose step of linear dynamics has no truncation error.
inline constexpr const char* kExactMethod = "exponential";

struct Promise {
  double error = 0.0;            ///< [-], bound, of the positions, up to known_until
  double rate_error = 0.0;       ///< [-], of the rates likewise
  double reference_error = 0.0;  ///< [-], how much of `error` is the reference's own
  double kept_until = 0.0;       ///< [s] from the start: so long it is below the tolerance
  double known_until = 0.0;      ///< [s] from the start: the horizon, if it can be
  bool kept = false;             ///< the tolerance, over the whole horizon
};

/// Has a scene of one system a step without truncation error: is it linear, at constant speed?
bool stepsAreExact(const Scene& one, const ModelSetup& setup);
/// A reference of a scene of one system: by methods that have nothing in common, where it has such;
/// by the only one, or the exact one, at different steps where not.
ReferenceTrajectory referenceOf(const Scene& one, const ModelSetup& setup, std::int64_t interval,
                                std::size_t samples, double wanted, EvaluationBudget& budget);

/// Judges the ways to step a scene of one system.
class StepJudge {
 public:
  /// Takes a reference; it may use most of the budget, which outlives the judge.
  StepJudge(const Scene& one, const ModelSetup& setup, EvaluationBudget& budget);

  const ReferenceTrajectory& reference() const { return reference_; }
  /// The reference is as good as is wanted over a good part of the horizon: what it likes there
  /// will do later, too.
  bool knowsMuch() const { return 4.0 * static_cast<double>(known_) >= samples_; }

  /// How many times the error that is aimed at, well below the tolerance, a setting has: at most 1
  /// where it will do. Where the reference knows no better than that, what is as good as it will
  /// do, too. Infinite where the budget is spent.
  double excess(const StepSetting& setting);
  /// The same at so many times the step, at times that such steps reach.
  double excessAtLongerSteps(const StepSetting& setting, int times);
  /// Steps of a method over the time that the reference knows.
  double knownSteps(const StepSetting& setting) const;
  Promise promise(const StepSetting& setting);

 private:
  Trajectory run(const StepSetting& setting, std::int64_t interval, ErrorCurve* curve);
  double excessOf(const StepSetting& setting, std::int64_t interval);
  double seconds(std::size_t sample) const;

  const Scene& one_;
  EvaluationBudget& budget_;
  std::int64_t interval_ = 0;  // [ns], of the samples
  double samples_ = 0.0;       // over the horizon
  bool exact_ = false;
  ReferenceTrajectory reference_;
  std::size_t known_ = 0;     // the last sample at which the reference is as good as is wanted
  std::size_t followed_ = 0;  // the last at which it has not yet parted
};

}  // namespace whirl_twin

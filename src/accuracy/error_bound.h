// Error bound of a step setting for a system: its error over the horizon, and how long it satisfies
// the tolerance, measured against a reference (reference_trajectory.h) from the scene's start.
//
// Nothing is extrapolated beyond the end of the reference, except for exact steps of linear systems
// at constant speed, whose rounding error grows no faster than the time.
#pragma once

#include <cstdint>

#include "accuracy/reference_trajectory.h"
#include "models/model_info.h"

namespace whirl_twin {

/// The method whose step of linear dynamics has no truncation error.
inline constexpr const char* kExactMethod = "exponential";

struct ErrorBound {
  double error = 0.0;            ///< [-], bound, of the positions, up to known_until
  double rate_error = 0.0;       ///< [-], of the rates likewise
  double reference_error = 0.0;  ///< [-], share of `error` due to the reference
  double kept_until = 0.0;       ///< [s] from the start: end of the time below the tolerance
  double known_until = 0.0;      ///< [s] from the start: the horizon, if possible
  bool kept = false;             ///< the tolerance, over the whole horizon
};

/// Whether a scene of one system has a step without truncation error: linear, at constant speed.
bool stepsAreExact(const Scene& one, const ModelSetup& setup);
/// A reference of a scene of one system: by two unrelated methods, where available; else by the
/// only one, or the exact one, at different steps.
ReferenceTrajectory referenceOf(const Scene& one, const ModelSetup& setup, std::int64_t interval,
                                std::size_t samples, double wanted, EvaluationBudget& budget);

/// Evaluates step settings for a scene of one system.
class StepJudge {
 public:
  /// Computes a reference; it may use most of the budget, which must outlive this object.
  StepJudge(const Scene& one, const ModelSetup& setup, EvaluationBudget& budget);

  const ReferenceTrajectory& reference() const { return reference_; }
  /// Whether the reference has the required accuracy over a large part of the horizon: settings
  /// accepted there are accepted for later times, too.
  bool knowsMuch() const { return 4.0 * static_cast<double>(known_) >= samples_; }

  /// Ratio of the error of a setting to the target error, which is well below the tolerance: at
  /// most 1 if accepted. Where the reference is less accurate than the target, a setting of equal
  /// accuracy is accepted, too. Infinite where the budget is spent.
  double excess(const StepSetting& setting);
  /// The same at a multiple of the step, at times that such steps reach.
  double excessAtLongerSteps(const StepSetting& setting, int times);
  /// Steps of a method over the time of the reference.
  double knownSteps(const StepSetting& setting) const;
  ErrorBound promise(const StepSetting& setting);

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
  std::size_t known_ = 0;     // the last sample with the required reference accuracy
  std::size_t followed_ = 0;  // the last sample before its divergence
};

}  // namespace whirl_twin

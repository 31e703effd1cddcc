// Reference trajectory for error measurement, with a bound of the error of the reference itself.
//
// It is computed twice, by two unrelated methods and at two steps of which neither is a multiple of
// the other, both finer than the scene's: twice their difference bounds the error of the better
// one. If the motion amplifies errors, the two may agree by chance: then a few roundings, amplified
// like a small perturbation of the initial state, bound the error too; where saturation has stopped
// that growth, a limit of an actuator for instance, the perturbation itself is the bound. Both
// steps are refined until they agree to the required accuracy, or refinement has no further effect.
// An event at the very end of a step may be detected only in the next step: the error at a sample
// is that of the sample after it, and where one of the two stops there, the sample is unknown.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "accuracy/trajectory.h"
#include "accuracy/trajectory_error.h"
#include "models/model_info.h"

namespace whirl_twin {

/// Trajectories whose positions differ by more than this have diverged [-].
inline constexpr double kDivergedDistance = 0.1;

/// Evaluations of accelerations that are left to spend, those of a pendulum of two coordinates.
class EvaluationBudget {
 public:
  EvaluationBudget(double evaluations, const Scene& one, const ModelSetup& setup);

  /// Cost of samples of a motion, an interval [ns] apart.
  double cost(const StepSetting& setting, std::int64_t interval, std::size_t samples) const;
  bool take(double cost);  ///< false, with nothing taken: there is less left
  double left() const { return left_; }
  /// The remaining budget, limited to `evaluations`.
  EvaluationBudget upTo(double evaluations) const;

 private:
  double size_;  // of an evaluation; it goes as the square of the coordinates
  double left_;
};

struct ReferenceTrajectory {
  StepSetting setting;
  StepSetting other;      ///< that it was compared with
  Trajectory trajectory;  ///< coordinates and rates, at most as many samples as were requested
  ErrorCurve difference;  ///< of the two, at the sample after
  ErrorCurve disturbed;   ///< of one from a start a little off; none: errors are not magnified
  ErrorCurve disturbed_by_rounding;  ///< of one off by no more than that; none: they are not much

  /// Bound of its position error up to a sample; infinite where the two have diverged.
  double error(std::size_t sample) const;
  double rateError(std::size_t sample) const;
  /// The last sample up to which its error is at most that.
  std::size_t lastWithin(double error) const;
};

/// Computed by `method` and by the one of `others` that agrees with it for the longest time (the
/// same method where there is no other): an explicit one is the better check, but a stiff system
/// needs an implicit one. `samples` are an interval [ns] apart, a multiple of the scene's step;
/// fewer where the budget ends or the motion diverges. magnifies: the motion may amplify errors.
ReferenceTrajectory referenceTrajectory(const Scene& one, const std::string& method,
                                        std::vector<std::string> others, bool magnifies,
                                        std::int64_t interval, std::size_t samples, double wanted,
                                        EvaluationBudget& budget);

}  // namespace whirl_twin

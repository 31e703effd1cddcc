// The trajectory that others are judged by, with a bound of its own error.
//
// It is taken twice, by two methods that have nothing in common and at two steps of which neither
// is a multiple of the other, both finer than the scene's: what the two differ by, twice over,
// bounds the error of the better one. Of a motion that magnifies errors, by luck they may have
// got the same ones: there some roundings, magnified as a small disturbance of the start is, bound
// it too; and where those have grown until something holds them, a limit of an actuator say, what
// that disturbance has become. Both steps are made finer until they agree as well as is wanted, or
// it helps no more. What happens at the very end of a step neither need see before the next: the
// error at a sample is that of the sample after it, and where one of the two stops there, the
// sample is not known.
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

  /// What samples of a motion cost, an interval [ns] apart.
  double cost(const StepSetting& setting, std::int64_t interval, std::size_t samples) const;
  bool take(double cost);  ///< false, with nothing taken: there is less left
  double left() const { return left_; }
  /// What is left if it were no more than that.
  EvaluationBudget upTo(double evaluations) const;

 private:
  double size_;  // of an evaluation; it goes as the square of the coordinates
  double left_;
};

struct ReferenceTrajectory {
  StepSetting setting;
  StepSetting other;      ///< that it was compared with
  Trajectory trajectory;  ///< coordinates and rates, at most as many samples as were asked for
  ErrorCurve difference;  ///< of the two, at the sample after
  ErrorCurve disturbed;   ///< of one from a start a little off; none: errors are not magnified
  ErrorCurve disturbed_by_rounding;  ///< of one off by no more than that; none: they are not much

  /// Bound of its position error up to a sample; infinite where the two have parted for good.
  double error(std::size_t sample) const;
  double rateError(std::size_t sample) const;
  /// The last sample up to which its error is at most that.
  std::size_t lastWithin(double error) const;
};

/// By `method` and the one of `others` that goes with it furthest (the same method where there is
/// no other): an explicit one is the better judge, but a stiff system needs an implicit. `samples`
/// an interval [ns] apart, a multiple of the scene's step; fewer where the budget ends or the
/// motion is lost. magnifies: its motion may do that to errors.
ReferenceTrajectory referenceTrajectory(const Scene& one, const std::string& method,
                                        std::vector<std::string> others, bool magnifies,
                                        std::int64_t interval, std::size_t samples, double wanted,
                                        EvaluationBudget& budget);

}  // namespace whirl_twin

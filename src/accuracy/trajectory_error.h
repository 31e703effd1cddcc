// Difference of two trajectories of a system, and its use in error bounds.
#pragma once

#include <cstddef>
#include <vector>

#include "accuracy/trajectory.h"

namespace whirl_twin {

/// The largest differences over a time. Infinite where the trajectory ends before.
struct TrajectoryError {
  /// [-], of the coordinates: metres relative to the largest of all sliding coordinates, radians in
  /// parts of the largest angle or of one radian, whichever is less.
  double position = 0.0;
  double radius = 0.0;  ///< [-], of the whirl, relative to the largest; NaN except for a rotor
  double phase =
      0.0;  ///< [rad], of the whirl, where its radius is above 1/1000 of the largest; NaN likewise
  double energy = 0.0;  ///< [-], of T + V, relative to the largest |T + V| or to its largest change
};

/// Over the first `samples` samples of the reference.
TrajectoryError trajectoryError(const Trajectory& trajectory, const Trajectory& reference,
                                std::size_t samples);

/// The largest differences of a trajectory from another, up to each sample, in parts of the largest
/// coordinates (or rates) of that other up to there.
class ErrorCurve {
 public:
  ErrorCurve() = default;
  /// As far as both go. The trajectory's interval is a multiple of the reference's.
  ErrorCurve(const Trajectory& trajectory, const Trajectory& reference);
  /// To be taken in parts of the largest coordinates (and rates) of the whole motion.
  static ErrorCurve inPartsOf(const Trajectory& whole);

  /// Takes the next sample of a trajectory. False: the trajectory or the reference ends before.
  bool take(const Trajectory& trajectory, const Trajectory& reference);

  /// Each sample except the first is assigned the errors of the next; the last is dropped.
  void holdAgainstTheSampleBefore();

  std::size_t samples() const { return position_.size(); }
  /// [-], as TrajectoryError::position; infinite beyond the last sample.
  double position(std::size_t sample) const;
  /// [-], of rates in m/s and in rad/s, each relative to the largest of its kind.
  double rate(std::size_t sample) const;

 private:
  struct ByUnit {
    double length = 0.0;
    double angle = 0.0;
    double& of(bool angular) { return angular ? angle : length; }
  };
  ByUnit position_scale_, rate_scale_;  // so far, or of the whole motion
  ByUnit position_error_, rate_error_;  // so far
  std::vector<double> position_, rate_;
};

}  // namespace whirl_twin

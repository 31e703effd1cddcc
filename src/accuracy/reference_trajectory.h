// The trajectory that others are judged by, with a bound of its own error.
#pragma once

#include <string>
#include <utility>
#include <vector>

#include "accuracy/trajectory.h"
#include "accuracy/trajectory_error.h"

namespace whirl_twin {

struct ReferenceTrajectory {
  StepSetting setting;
  Trajectory trajectory;
  /// Position error, bounded from the difference from steps twice as long and how that falls with
  /// the step: at least a quarter of it (order six promises a 63rd), all of it at rounding; and
  /// from what becomes of some roundings of the start.
  double error = 0.0;
  double growth = 0.0;  ///< [-], of a small disturbance of the start, at most
  /// Those on the way, with their substeps, coarse to fine.
  std::vector<std::pair<int, Trajectory>> coarser;

  /// The first samples, in which the error is at most that: fewer than all where the motion
  /// magnifies rounding, or where the method converges slowly.
  std::size_t samplesWithin(double most) const;

  Trajectory disturbed;  ///< as the first of `coarser`, but from a start slightly off
};

/// Doubles the substeps of a method, at most until there are `most_substeps`, until the error is
/// `wanted` or nothing is gained any more. duration and interval [ns] are multiples of the scene's
/// step.
ReferenceTrajectory referenceTrajectory(const Scene& one, const std::string& integrator,
                                        std::int64_t duration, std::int64_t interval, double wanted,
                                        int most_substeps = 256);

}  // namespace whirl_twin

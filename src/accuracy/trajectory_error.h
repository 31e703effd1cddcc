// How far one trajectory of a system is from another, and what that means for a promise.
#pragma once

#include <cstddef>

#include "accuracy/trajectory.h"

namespace whirl_twin {

/// The largest differences over a time. Infinite where the trajectory ends before.
struct TrajectoryError {
  /// [-], of the coordinates: metres in parts of the largest of all sliding coordinates, radians in
  /// parts of the largest angle or of one radian, whichever is less.
  double position = 0.0;
  double radius = 0.0;  ///< [-], of the whirl, in parts of the largest; NaN but for a rotor
  double phase =
      0.0;  ///< [rad], of the whirl, where its radius is above 1/1000 of the largest; NaN likewise
  double energy = 0.0;  ///< [-], of T + V, in parts of the largest |T + V| or of its largest change
};

/// Over the first `samples` samples of the reference.
TrajectoryError trajectoryError(const Trajectory& trajectory, const Trajectory& reference,
                                std::size_t samples);

/// Number of samples, from the start, in which the positions of two trajectories differ by at most
/// `tolerance` (as TrajectoryError::position).
std::size_t samplesWithin(const Trajectory& trajectory, const Trajectory& reference,
                          double tolerance);

}  // namespace whirl_twin

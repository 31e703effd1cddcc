// Newton's method for one steady motion: the shape is constant, the cyclic coordinates move at
// constant rates.
#pragma once

#include <Eigen/Core>
#include <optional>

#include "analysis/cyclic_coordinates.h"
#include "mechanics/dynamics.h"

namespace whirl_twin {

struct SteadyMotion {
  Eigen::VectorXd q, v;  ///< v is zero but for cyclic coordinates
};

/// From a start, at the given conserved momenta (other entries are ignored) and shaft speed
/// [rad/s]; rates of driven coordinates are found with the shape. Nothing if it does not converge,
/// or if nothing but inertia resists some coordinate.
std::optional<SteadyMotion> steadyMotionNear(const Dynamics& dynamics,
                                             const CyclicCoordinates& cyclic,
                                             const SteadyMotion& start,
                                             const Eigen::VectorXd& momenta, double speed);

/// Where the shape comes to, let go at the start and damped so strongly that it only creeps: down
/// the slope of the reduced potential, by implicit steps of bounded length and number. Nothing for
/// a linear system and where driven coordinates take part.
std::optional<SteadyMotion> creepsTo(const Dynamics& dynamics, const CyclicCoordinates& cyclic,
                                     const SteadyMotion& start, const Eigen::VectorXd& momenta,
                                     double speed);

}  // namespace whirl_twin

// Can the accelerations be found at all? They are M^-1 times a force.
#pragma once

#include <Eigen/Core>

#include "mechanics/dynamics.h"

namespace whirl_twin {

/// Smallest over largest eigenvalue of M(q), each coordinate in its natural unit (rad, or the
/// model's natural length): 0 or less where some motion has no inertia. [-]
double massRegularity(const Dynamics& dynamics, const Eigen::VectorXd& q, const Eigen::VectorXd& v,
                      const Moment<double>& at);

/// Below this the accelerations are mostly rounding; at kSingularMass they are nothing else.
constexpr double kNearlySingularMass = 1.0e-10;
constexpr double kSingularMass = 1.0e-15;

/// A radian of each coordinate: of a sliding one, the model's natural length [m].
Eigen::VectorXd naturalUnits(const Dynamics& dynamics);

}  // namespace whirl_twin

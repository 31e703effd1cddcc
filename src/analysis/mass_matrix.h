// Can the accelerations be found at all? They are M^-1 times a force.
#pragma once

#include <Eigen/Core>

#include "mechanics/dynamics.h"

namespace whirl_twin {

/// Smallest over largest eigenvalue of M(q), each coordinate in its natural unit (rad, or the
/// model's natural length): 0 or less where some motion has no inertia. [-]
double massRegularity(const Dynamics& dynamics, const Eigen::VectorXd& q, const Eigen::VectorXd& v,
                      const Moment<double>& at);

/// Below this regularity the accelerations may be mostly rounding.
constexpr double kNearlySingularMass = 1.0e-10;

/// Has some motion no inertia at all? Judged on M scaled to unit diagonal, so that masses may be as
/// different as they like.
bool massIsSingular(const Dynamics& dynamics, const Eigen::VectorXd& q, const Eigen::VectorXd& v,
                    const Moment<double>& at);

/// A radian of each coordinate: of a sliding one, the model's natural length [m].
Eigen::VectorXd naturalUnits(const Dynamics& dynamics);

}  // namespace whirl_twin

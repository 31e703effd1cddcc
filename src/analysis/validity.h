// Do the equations of a system describe the machine at this state? A disc may have lifted off, a
// slider left its rod, a plank tipped, a coordinate lost its inertia.
#pragma once

#include <Eigen/Core>
#include <vector>

#include "mechanics/dynamics.h"

namespace whirl_twin {

/// Does the system have conditions at all?
bool hasConditions(const Dynamics& dynamics);

/// Every condition of the model, and `regular_mass` where its mass matrix can become singular:
/// there the accelerations are mostly rounding. Each holds while its margin > 0.
std::vector<Condition> validity(const Dynamics& dynamics, const Eigen::VectorXd& q,
                                const Eigen::VectorXd& v, const Moment<double>& at);

/// The conditions broken, in words: "the disc lifts off its plane (contact)"; "" if all hold. With
/// their margins, "(contact -0.31 N)".
enum class Margins { kShown, kLeftOut };
std::string brokenText(const std::vector<Condition>& conditions, Margins margins);

}  // namespace whirl_twin

// Validity of the equations of a system at a state: a disc may have lifted off, a slider left its
// rod, a plank tipped, a coordinate lost its inertia.
#pragma once

#include <Eigen/Core>
#include <optional>
#include <string>
#include <vector>

#include "analysis/steady_motion.h"
#include "mechanics/dynamics.h"

namespace whirl_twin {

// Up to which amplitude a logarithmic decrement holds. It is that of small motions: of a nonlinear
// system it changes as the motion becomes wider (a pendulum swings more slowly, a rotor meets its
// stator, a film stiffens).
//
// Of a motion of finite amplitude it is that of the equivalent linear system (describing function,
// Krylov & Bogoliubov 1937): the system is moved through its least damped mode, and of what its
// equations answer that part counts which has the mode's own shape and frequency. It is exact for a
// linear system, and good where a motion stays near that shape.

/// A decrement belongs to an amplitude where it is no further from that of small motions.
constexpr double kSameDecrement = 0.1;  // [-], of it

struct LinearDampingLimit {
  double amplitude = 0.0;  ///< [rad] or [m]; infinite: as far as was looked, half a turn or
                           ///< naturalLength()
  std::string coordinate;  ///< of it, that which moves most; of a rotor "whirl": its radius at the
                           ///< first station
};

/// Of the least damped vibration about a steady motion at a shaft speed [rad/s]. Nothing where
/// nothing vibrates, or two modes coincide (their shapes are then undefined).
std::optional<LinearDampingLimit> linearDampingLimit(const Dynamics& dynamics,
                                                     const SteadyMotion& motion, double speed);

/// Does the system have conditions at all?
bool hasConditions(const Dynamics& dynamics);

/// Every condition of the model, and `regular_mass` where its mass matrix can become singular:
/// there the accelerations are mostly rounding. Each holds while its margin > 0.
std::vector<Condition> validity(const Dynamics& dynamics, const Eigen::VectorXd& q,
                                const Eigen::VectorXd& v, const EvaluationPoint<double>& at);

/// The conditions broken, in words: "the disc lifts off its plane (contact)"; "" if all hold. With
/// their margins, "(contact -0.31 N)".
enum class Margins { kShown, kLeftOut };
std::string brokenText(const std::vector<Condition>& conditions, Margins margins);

}  // namespace whirl_twin

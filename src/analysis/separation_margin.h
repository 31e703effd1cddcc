// Separation margin: how far a running speed has to stay from a critical speed Nc.
//
// API 617 and API RP 684, from the amplification factor AF = Nc / (N2 - N1), N1 and N2 where the
// response is 0.707 of its peak:
//   AF < 2.5                      critically damped, no margin required
//   critical below the speed N    SM = 100 (N - Nc) / N   >= min(16, 17 (1 - 1/(AF - 1.5))) %
//   critical above the speed N    SM = 100 (Nc - N) / N   >= min(26, 10 + 17 (1 - 1/(AF - 1.5))) %
// The caps are reached at AF = 18.5. Some editions compare the upper margin with the trip speed:
// check the clause against the edition in force.
#pragma once

#include <string>

#include "control/exclusion_bands.h"
#include "messages/stability_margin.h"

namespace whirl_twin {

/// Below this amplification factor a mode counts as critically damped [-].
inline constexpr double kCriticallyDampedAmplification = 2.5;

/// Required margin [percent] of a running speed above the critical speed; 0 when critically damped
/// or when the amplification factor [-] is undefined (NaN).
double requiredMarginBelow(double amplification_factor);

/// Required margin [percent] of a running speed below the critical speed; 0 when critically damped
/// or when the amplification factor [-] is undefined (NaN).
double requiredMarginAbove(double amplification_factor);

/// Actual margin [percent of |running_speed|] to a critical speed on either side of it; both in
/// rad/s, the sense of rotation does not matter. NaN at standstill.
double separationMargin(double running_speed, double critical_speed);

/// Required margin [percent] on that side of the critical speed the running speed [rad/s] is on.
double requiredSeparationMargin(double running_speed, double critical_speed,
                                double amplification_factor);

/// Running speeds that violate the required margin around one critical speed [rad/s]: [Nc / (1 +
/// SM_above/100), Nc / (1 - SM_below/100)]; empty, both ends at Nc, when critically damped.
SpeedBand criticalBand(double critical_speed, double amplification_factor);

/// All of the above for one critical speed [rad/s] seen from the present speed [rad/s].
/// direction: "forward" or "backward".
state::CriticalSpeedMargin criticalSpeedMargin(double running_speed, double critical_speed,
                                               const std::string& direction,
                                               double amplification_factor);

}  // namespace whirl_twin

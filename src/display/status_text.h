// What the displays and the terminal say in words about a system: angles, whirl, margins, alerts.
// Here, and only here, angles are in degrees, whirl radii in micrometres and speeds also in rpm.
#pragma once

#include <string>
#include <vector>

#include "mechanics/dynamics.h"
#include "whirl_twin/Alert.h"
#include "whirl_twin/FollowState.h"
#include "whirl_twin/OrderState.h"
#include "whirl_twin/PendulumState.h"
#include "whirl_twin/StabilityMargin.h"
#include "whirl_twin/WhirlState.h"

namespace whirl_twin {

// What a display says of a system that follows its machine.

/// A line for each estimated parameter, "coulomb1 0.00029 +- 6e-05 N m"; then each channel that is
/// not used, and how far the residuals are from what is expected.
std::vector<std::string> followLines(const FollowState& follow);

/// [rad] to degrees in (-180, 180].
double wrappedDegrees(double angle);

/// "speed 100.00 rad/s (954.9 rpm)".
std::string speedText(double speed);

/// "vibration 123.4 um", of the amplitude over a revolution [m] that alarms go by; "" of NaN,
/// before there is a revolution.
std::string vibrationText(double amplitude);

/// "1X 120.0 um, lag 34.5 deg, forward": the first order, in which sense the whirl runs, and the
/// largest line if it is larger than the first order; without orders what there is.
std::string ordersText(const OrderState& orders);

/// Coordinates of which only the names are known: an angle is named so, all others are lengths.
std::vector<CoordinateInfo> coordinatesByName(const std::vector<std::string>& name);

/// "theta 12.3 deg, x -4e-05 m".
std::string coordinateText(const std::vector<CoordinateInfo>& coordinates,
                           const std::vector<double>& value);

/// "kinetic 0.12 J, potential 0.5 J".
std::string energyText(const PendulumState& state);

/// Index of the critical speed nearest to the present speed; -1 when there is none.
int nearestCriticalSpeed(const StabilityMargin& margin);

/// "critical 100.0 rad/s forward"; empty when there is no such critical speed.
std::string criticalSpeedText(const StabilityMargin& margin, int index);

/// "margin 34.0 % (16.0 % required)", of the present speed from it; empty at standstill.
std::string separationText(const StabilityMargin& margin, int index);

/// "asymptotically stable".
std::string verdictText(const StabilityMargin& margin);

/// "decay rate 5 1/s, log decrement 0.314", as far as they are finite; "growth rate" when negative.
std::string decayText(const StabilityMargin& margin);

/// Everything a display writes about a margin, a line each.
std::vector<std::string> marginLines(const StabilityMargin& margin);

/// "INFO", "WARNING" or "DANGER".
std::string severityName(int severity);

/// Breaks a sentence at spaces into lines of at most `width` characters, indented from the second
/// on; a word that is longer stays whole.
std::vector<std::string> wrapText(const std::string& sentence, std::size_t width);

/// Lines joined with newlines.
std::string joinedLines(const std::vector<std::string>& lines);

}  // namespace whirl_twin

// The texts of the displays and the terminal about a system: angles, whirl, margins, alerts. Here,
// and only here, angles are in degrees, whirl radii in micrometres and speeds also in rpm.
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

// Display texts of a system with a state estimator.

/// A line for each estimated parameter, "coulomb1 0.00029 +- 6e-05 N m"; then each unused channel,
/// and the deviation of the residuals from their expected statistics.
std::vector<std::string> followLines(const FollowState& follow);

/// [rad] to degrees in (-180, 180].
double wrappedDegrees(double angle);

/// "speed 100.00 rad/s (954.9 rpm)".
std::string speedText(double speed);

/// "vibration 123.4 um", the amplitude over a revolution [m] that alarms use; "" for NaN, before a
/// complete revolution.
std::string vibrationText(double amplitude);

/// "1X 120.0 um, lag 34.5 deg, forward": the first order, the sense of the whirl, and the largest
/// non-synchronous component if it exceeds the first order; without orders the available values.
std::string ordersText(const OrderState& orders);

/// Coordinates with known names only: angles are identified by their names, all others are lengths.
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

/// "decay rate 5 1/s, log decrement 0.314", as far as finite; "growth rate" when negative.
std::string decayText(const StabilityMargin& margin);

/// All display texts on a margin, one per line.
std::vector<std::string> marginLines(const StabilityMargin& margin);

/// "INFO", "WARNING" or "DANGER".
std::string severityName(int severity);

/// Breaks a sentence at spaces into lines of at most `width` characters, indented from the second
/// on; a longer word is not broken.
std::vector<std::string> wrapText(const std::string& sentence, std::size_t width);

/// Lines joined with newlines.
std::string joinedLines(const std::vector<std::string>& lines);

}  // namespace whirl_twin

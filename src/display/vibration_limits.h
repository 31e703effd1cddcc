// The vibration limits of this twin's monitor, from the parameters of its node
// (config/monitor.yaml), for displays.
#pragma once

#include <string>
#include <vector>

#include "display/marker_canvas.h"
#include "monitoring/alarm_settings.h"

namespace whirl_twin {

/// Limit circle of an orbit.
struct VibrationLimit {
  double radius = 0.0;  ///< [m], about the middle of the orbit
  int severity = 0;     ///< of the alert beyond it (Alert.msg); INFO: end of zone A
  std::string name;     ///< "zone B", "alert level"
};

/// Limits of a rotor at a speed [rad/s] of its shaft. Zones are peak-to-peak values; the radius of
/// the circle is half of that.
std::vector<VibrationLimit> vibrationLimits(const AlarmSettings& settings,
                                            const std::string& system, double speed);

/// "limits 110 um (zone C), ...": danger first.
std::string limitsText(const std::vector<VibrationLimit>& limits);

/// The parameters of a monitor node, such as /monitor_node, for these rotors; the defaults where
/// they are missing or invalid.
AlarmSettings settingsOfMonitor(const std::string& node, const std::vector<std::string>& rotors);

}  // namespace whirl_twin

// The levels of vibration that the monitor of this twin watches, as its node has them
// (config/monitor.yaml), for displays.
#pragma once

#include <string>
#include <vector>

#include "display/marker_canvas.h"
#include "monitoring/alarm_settings.h"

namespace whirl_twin {

/// A circle that an orbit should stay within.
struct VibrationLimit {
  double radius = 0.0;  ///< [m], about the middle of the orbit
  int severity = 0;     ///< of the alert beyond it (Alert.msg); INFO: end of zone A
  std::string name;     ///< "zone B", "alert level"
};

/// Those of a rotor at a speed [rad/s] of its shaft. Zones are of peak-to-peak values, a circle of
/// which has half of that as its radius.
std::vector<VibrationLimit> vibrationLimits(const AlarmSettings& settings,
                                            const std::string& system, double speed);

/// "limits 110 um (zone C), ...": danger first.
std::string limitsText(const std::vector<VibrationLimit>& limits);

/// The parameters of a node of the monitor, such as /monitor_node, for these rotors; the default
/// ones where there are none, or they are not right.
AlarmSettings settingsOfMonitor(const std::string& node, const std::vector<std::string>& rotors);

}  // namespace whirl_twin

#include "display/vibration_limits.h"

#include <fmt/format.h>
#include <ros/ros.h>

#include <cmath>

#include "messages/input_error.h"
#include "monitoring/alarm_settings_reader.h"
#include "transport/ros_parameters.h"
#include "whirl_twin/Alert.h"

namespace whirl_twin {

std::vector<VibrationLimit> vibrationLimits(const AlarmSettings& settings,
                                            const std::string& system, double speed) {
  std::vector<VibrationLimit> limits;
  const auto zones = settings.zones.find(system);
  if (zones != settings.zones.end()) {
    limits.push_back({0.5 * zones->second.a, Alert::INFO, "zone A"});
    limits.push_back({0.5 * zones->second.b, Alert::WARNING, "zone B"});
    limits.push_back({0.5 * zones->second.c, Alert::DANGER, "zone C"});
  }
  const auto levels = settings.amplitude.find(system);
  if (levels != settings.amplitude.end()) {
    const double alert = levels->second.alertAt(speed);
    const double danger = levels->second.dangerAt(speed);
    if (std::isfinite(alert)) {
      limits.push_back({alert, Alert::WARNING, "alert level"});
    }
    if (std::isfinite(danger)) {
      limits.push_back({danger, Alert::DANGER, "danger level"});
    }
  }
  return limits;
}

std::string limitsText(const std::vector<VibrationLimit>& limits) {
  std::string text;
  for (auto limit = limits.rbegin(); limit != limits.rend(); ++limit) {
    text += fmt::format("{}{} {:.4g} um", text.empty() ? "limits: " : ", ", limit->name,
                        1.0e6 * limit->radius);
  }
  return text;
}

AlarmSettings settingsOfMonitor(const std::string& node, const std::vector<std::string>& rotors) {
  XmlRpc::XmlRpcValue all;
  if (!ros::param::get(node, all) || all.getType() != XmlRpc::XmlRpcValue::TypeStruct) {
    return {};
  }
  YAML::Node given = toYaml(all);
  YAML::Node levels(YAML::NodeType::Map);  // the parameters that are drawn
  for (const char* key : {"amplitude", "zones", "log_decrement_warning", "decay_rate_alarm"}) {
    if (given[key]) {
      levels[key] = given[key];
    }
  }
  try {
    return readAlarmSettings(levels, node, rotors, {});
  } catch (const InputError&) {
    return {};  // the monitor itself reports the error
  }
}

}  // namespace whirl_twin

// ~set_alarm_settings: the settings of the monitor, changed while it runs. The parameters of the
// node follow, so that a monitor that comes back has what was set last; set by themselves they are
// obeyed, too.
#pragma once

#include <ros/ros.h>
#include <whirl_twin/SetAlarmSettings.h>

#include <functional>
#include <string>
#include <vector>

#include "monitoring/live_alarm_settings.h"
#include "monitoring/twin_monitor.h"

namespace whirl_twin {

/// Parameters of the node that are no settings of the alarms.
std::vector<std::string> parametersAtStart();
/// The settings that the node's parameters have. Throws Refusal for parameters of the node that are
/// unknown, or out of range.
LiveAlarmSettings alarmSettingsOf(const BuiltScene& scene);

class AlarmSettingsService {
 public:
  /// Advertises under `own`, the node itself. was_changed: called with the text of a change.
  AlarmSettingsService(TwinMonitor& monitor, LiveAlarmSettings& settings, ros::NodeHandle own,
                       std::function<void(const std::string&)> was_changed);

  /// Parameters of the node that were set without the service, all settings of the alarms; returns
  /// why they are refused, or "".
  std::string obey(const YAML::Node& all);

 private:
  bool set(SetAlarmSettings::Request& request, SetAlarmSettings::Response& response);
  void tellParameters(const YAML::Node& before);

  TwinMonitor& monitor_;
  LiveAlarmSettings& settings_;
  ros::NodeHandle own_;
  std::function<void(const std::string&)> was_changed_;
  ros::ServiceServer server_;
};

}  // namespace whirl_twin

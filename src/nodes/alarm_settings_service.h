// ~set_alarm_settings: changes the settings of the monitor while it runs. The parameters of the
// node are updated, so that a restarted monitor has the latest settings; changes of these
// parameters by `rosparam set` are applied, too.
#pragma once

#include <ros/ros.h>
#include <whirl_twin/SetAlarmSettings.h>

#include <functional>
#include <string>
#include <vector>

#include "monitoring/alarm_settings_reader.h"
#include "monitoring/twin_monitor.h"

namespace whirl_twin {

/// The settings by the node's parameters; `others` are no alarm settings. Throws InputError for
/// parameters of the node that are unknown or out of range.
LiveAlarmSettings alarmSettingsOf(const BuiltScene& scene, std::vector<std::string> others);

class AlarmSettingsService {
 public:
  /// Advertises under `own`, the node itself. was_changed: called with a description of a change.
  AlarmSettingsService(TwinMonitor& monitor, LiveAlarmSettings& settings, ros::NodeHandle own,
                       std::function<void(const std::string&)> was_changed);

  /// Applies parameters of the node that were changed without the service, all of the settings;
  /// returns why they are rejected, or "".
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

// Reads the settings of the monitor, config/monitor.yaml, with all that is wrong with them at once.
#pragma once

#include <yaml-cpp/yaml.h>

#include <string>
#include <vector>

#include "monitoring/alarm_settings.h"

namespace whirl_twin {

/// source: names the tree in messages. rotors: the systems of the scene that have a whirl. besides:
/// keys that stand there for others, and are left to them. stations: further names that a whirl of
/// the scene is published with. What is not said has its default. Throws SceneError.
AlarmSettings readAlarmSettings(const YAML::Node& tree, const std::string& source,
                                const std::vector<std::string>& rotors,
                                const std::vector<std::string>& besides,
                                const std::vector<std::string>& stations = {});

}  // namespace whirl_twin

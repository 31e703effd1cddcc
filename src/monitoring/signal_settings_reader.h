// What config/monitor.yaml sets for a rotor's signal: zones of vibration, levels of a rub, its slow
// roll. Complaints are at their keys.
#pragma once

#include <yaml-cpp/yaml.h>

#include <string>

#include "monitoring/alarm_settings.h"
#include "scene/node_reader.h"

namespace whirl_twin {

VibrationZones readZones(const YAML::Node& node, const std::string& key, Complaints& complaints);
RubLevels readRub(const YAML::Node& node, const std::string& key, Complaints& complaints);
SlowRoll readSlowRoll(const YAML::Node& node, const std::string& key, Complaints& complaints);

}  // namespace whirl_twin

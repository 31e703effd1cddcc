#include "tools/alarm_settings_file.h"

#include <vector>

#include "monitoring/alarm_settings_reader.h"
#include "scene/signal_names.h"
#include "scene/yaml_file.h"

namespace whirl_twin {

AlarmSettings alarmSettingsOf(const BuiltScene& scene, const std::optional<std::string>& path) {
  if (!path) {
    return {};
  }
  std::vector<std::string> rotors;
  std::vector<std::string> stations;
  for (const SharedSystem& system : scene.systems) {
    if (system->dynamics->isRotor()) {
      rotors.push_back(system->spec.name);
      const auto names = publishedStations(system->spec.name, *system->dynamics);
      stations.insert(stations.end(), names.begin() + 1, names.end());
    }
  }
  return readAlarmSettings(readYamlFile(*path, "settings of the monitor", "alarms"), *path, rotors,
                           {}, stations);
}

}  // namespace whirl_twin

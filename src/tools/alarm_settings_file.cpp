#include "tools/alarm_settings_file.h"

#include "monitoring/alarm_settings_reader.h"
#include "scene/yaml_file.h"

namespace whirl_twin {

AlarmSettings alarmSettingsOf(const BuiltScene& scene, const std::optional<std::string>& path) {
  if (!path) {
    return {};
  }
  const BuiltScene::RotorNames names = scene.rotorNames();
  return readAlarmSettings(readYamlFile(*path, "settings of the monitor", "alarms"), *path,
                           names.rotors, {}, names.stations);
}

}  // namespace whirl_twin

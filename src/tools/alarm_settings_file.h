// Settings of the monitor for a command: a file like config/monitor.yaml.
#pragma once

#include <optional>
#include <string>

#include "monitoring/alarm_settings.h"
#include "scene/built_scene.h"

namespace whirl_twin {

/// path: none: the defaults. Throws SceneError or InputError.
AlarmSettings alarmSettingsOf(const BuiltScene& scene, const std::optional<std::string>& path);

}  // namespace whirl_twin

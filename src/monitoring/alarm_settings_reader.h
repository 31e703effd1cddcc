// Reads the settings of the monitor, config/monitor.yaml, with all that is wrong with them at once.
#pragma once

#include <yaml-cpp/yaml.h>

#include <string>
#include <vector>

#include "monitoring/alarm_settings.h"

namespace whirl_twin {

/// source: names the tree in messages. rotors: the systems of the scene that have a whirl. besides:
/// keys that are read elsewhere. stations: further names that a whirl of the scene is published
/// with. A setting that is not given has its default. Throws SceneError.
AlarmSettings readAlarmSettings(const YAML::Node& tree, const std::string& source,
                                const std::vector<std::string>& rotors,
                                const std::vector<std::string>& besides,
                                const std::vector<std::string>& stations = {});

/// The settings of the monitor as they are now: those it was started with, and their changes since.
/// A change is written and checked like config/monitor.yaml.
class LiveAlarmSettings {
 public:
  /// As readAlarmSettings().
  LiveAlarmSettings(const YAML::Node& tree, const std::string& source,
                    std::vector<std::string> rotors, const std::vector<std::string>& besides = {},
                    std::vector<std::string> stations = {});

  /// The settings in `text`, YAML, replace those in force; others stay. Each entry of kSettingMaps
  /// is one such setting. Nothing (~) as a value removes a setting, to its default. Throws
  /// InputError with all that is wrong, and then nothing has changed.
  void change(const std::string& text);

  /// `tree` replaces all settings. `source` names it in errors. False: it is equal to them.
  bool replace(const YAML::Node& tree, const std::string& source);

  const AlarmSettings& settings() const { return settings_; }
  /// The settings given, without defaults.
  const YAML::Node& tree() const { return tree_; }
  /// The same as text.
  std::string text() const {
    YAML::Emitter out;
    out << YAML::Flow << tree_;
    return out.c_str();
  }

 private:
  std::vector<std::string> rotors_;
  std::vector<std::string> stations_;
  AlarmSettings settings_;
  YAML::Node tree_;
};

}  // namespace whirl_twin

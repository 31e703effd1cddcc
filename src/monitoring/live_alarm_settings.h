// The settings of the monitor as they are now: those it was started with, and what has been changed
// since while it runs. A change is written and checked like config/monitor.yaml.
#pragma once

#include <yaml-cpp/yaml.h>

#include <string>
#include <vector>

#include "monitoring/alarm_settings.h"

namespace whirl_twin {

class LiveAlarmSettings {
 public:
  /// As readAlarmSettings().
  LiveAlarmSettings(const YAML::Node& tree, const std::string& source,
                    std::vector<std::string> rotors, const std::vector<std::string>& besides = {},
                    std::vector<std::string> stations = {});

  /// What `text`, YAML, says takes the place of what was set; what it leaves out stays. delays,
  /// amplitude, voting, zones, subsynchronous, rub and slow_roll are maps: each of their entries is
  /// one such setting. Nothing (~) as a value takes a setting away, to its default. Throws Refusal
  /// with all that is wrong, and then nothing has changed.
  void change(const std::string& text);

  /// `tree` takes the place of all that was set. `source` names it in what is wrong, as change()
  /// says it. False: it is what was set.
  bool replace(const YAML::Node& tree, const std::string& source);

  const AlarmSettings& settings() const { return settings_; }
  /// What is set, without defaults.
  const YAML::Node& tree() const { return tree_; }
  /// The same as text.
  std::string text() const;

 private:
  std::vector<std::string> rotors_;
  std::vector<std::string> stations_;
  AlarmSettings settings_;
  YAML::Node tree_;
};

}  // namespace whirl_twin

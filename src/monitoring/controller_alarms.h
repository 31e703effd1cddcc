// All alarms on the controllers of a scene.
#pragma once

#include <map>
#include <string>

#include "messages/controller_state.h"
#include "monitoring/alarm_settings.h"
#include "monitoring/alert_list.h"
#include "monitoring/controller_alarm.h"
#include "monitoring/loop_alarm.h"
#include "monitoring/passage_alarm.h"
#include "monitoring/saturation_alarm.h"
#include "scene/scene.h"

namespace whirl_twin {

class ControllerAlarms {
 public:
  ControllerAlarms(const Scene& scene, const AlarmSettings& settings);

  bool watch(const std::string& controller) const { return all_.count(controller) > 0; }
  /// Other settings from now on.
  void set(const AlarmSettings& settings);
  /// They forget what has been.
  void restart(const AlarmSettings& settings);
  /// Of a controller that is watched.
  void update(const state::ControllerState& controller, AlertList& alerts);
  /// Likewise; and the margins are told what part of its outputs and samples was wanting.
  void update(state::ControllerMargins& margins, AlertList& alerts);

 private:
  struct Alarms {
    ControllerAlarm lost;
    LoopAlarm loop;
    SaturationAlarm saturation;
    PassageAlarm passage;
  };
  std::map<std::string, Alarms> all_;
};

}  // namespace whirl_twin

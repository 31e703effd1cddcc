// RESONANCE_NOT_PASSED: a resonance keeps a shaft from the speed that its controller is to bring it
// to, and says which way: refused beforehand (a warning); captured and on its way back, trying
// again, given up (a danger, once it was captured). Of the controller by its name; clears when the
// shaft has passed.
#pragma once

#include <string>

#include "messages/controller_state.h"
#include "monitoring/alarm_settings.h"
#include "monitoring/alert_list.h"
#include "monitoring/condition_alarm.h"
#include "scene/controller_spec.h"

namespace whirl_twin {

class PassageAlarm {
 public:
  PassageAlarm(const ControllerSpec& controller, const AlarmSettings& settings);

  /// Forgets what has been.
  void restart(const AlarmSettings& settings);
  /// Other settings from now on.
  void set(const AlarmSettings& settings);
  void update(const state::ControllerState& controller, AlertList& alerts);

 private:
  std::string controller_;
  std::string refusal_;  ///< what is known beforehand; "" without
  ConditionAlarm alarm_;
};

}  // namespace whirl_twin

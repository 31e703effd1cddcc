// LOOP_SENSITIVITY: the sensitivity of a controller's loop peaks above `sensitivity_warning`, by
// default where zone C of ISO 14839-3:2006 begins, or is without bound; a warning, of the
// controller by its name. Of a loop that is unstable, or cannot be judged, others speak: it holds.
#pragma once

#include <string>

#include "messages/controller_state.h"
#include "monitoring/alarm_settings.h"
#include "monitoring/alert_list.h"
#include "monitoring/condition_alarm.h"

namespace whirl_twin {

class LoopAlarm {
 public:
  LoopAlarm(std::string controller, const AlarmSettings& settings);

  /// Other settings from now on.
  void set(const AlarmSettings& settings);
  void update(const state::ControllerMargins& margins, AlertList& alerts);

 private:
  AlarmCondition conditionOf(const state::ControllerMargins& margins) const;

  std::string controller_;
  double limit_ = 0.0;       // [-]; 0: not watched
  double hysteresis_ = 0.0;  // [-]
  ConditionAlarm alarm_;
};

}  // namespace whirl_twin

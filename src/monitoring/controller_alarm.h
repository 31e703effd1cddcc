// CONTROLLER_LOST: a controller in another process has not answered for its time-out; a danger, of
// the controller by its name. Clears when it answers again.
#pragma once

#include <string>

#include "monitoring/alarm_settings.h"
#include "monitoring/alert_list.h"
#include "monitoring/condition_alarm.h"

namespace whirl_twin {

class ControllerAlarm {
 public:
  ControllerAlarm(std::string controller, const AlarmSettings& settings);

  /// Other settings from now on.
  void set(const AlarmSettings& settings);
  /// lost: what the twin says at time [s, simulated].
  void update(double time, bool lost, AlertList& alerts);

 private:
  std::string controller_;
  ConditionAlarm alarm_;
};

}  // namespace whirl_twin

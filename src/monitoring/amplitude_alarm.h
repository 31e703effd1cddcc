// WHIRL_AMPLITUDE: the vibration of a rotor over a revolution (whirl_vibration.h) is above its
// alert level (a warning) or its danger level, as set for the speed of its shaft. While the shaft
// starts up, and clear_delay after, the levels are multiplied (trip multiply): the resonances it
// passes are expected, and the protection does not go blind meanwhile.
#pragma once

#include <string>

#include "monitoring/alarm_settings.h"
#include "monitoring/alert_list.h"
#include "monitoring/condition_alarm.h"
#include "monitoring/start_up.h"

namespace whirl_twin {

class AmplitudeAlarm {
 public:
  AmplitudeAlarm(std::string system, const AlarmSettings& settings);

  /// Other settings from now on; what it knows of its cause, and for how long, stays.
  void set(const AlarmSettings& settings);
  /// amplitude [m] at time [s, simulated], with the speed [rad/s] and acceleration [rad/s^2] of the
  /// shaft. A NaN neither raises nor clears.
  void update(double time, double amplitude, double speed, double acceleration, AlertList& alerts);
  /// What comes cannot be judged: delays are broken, and nothing is raised or cleared.
  void hold() { alarm_.hold(); }

 private:
  std::string system_;
  AmplitudeLevels levels_;
  bool has_levels_ = false;
  double hysteresis_ = 0.0;
  StartUp start_up_;
  ConditionAlarm alarm_;
};

}  // namespace whirl_twin

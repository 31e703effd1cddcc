// SOMMERFELD_CAPTURE: a motor whose torque is below what a resonance takes does not bring its rotor
// through. A warning as long as the rotor is on its way there, danger when its speed stands still
// in or below the band: all that the motor gives then goes into the whirl.
#pragma once

#include <string>
#include <vector>

#include "messages/states.h"
#include "monitoring/alarm_settings.h"
#include "monitoring/alert_list.h"
#include "monitoring/capture_speeds.h"
#include "monitoring/condition_alarm.h"

namespace whirl_twin {

class CaptureAlarm {
 public:
  CaptureAlarm(std::string system, const AlarmSettings& settings);

  /// Other settings from now on; what it knows of its cause, and for how long, stays.
  void set(const AlarmSettings& settings);
  /// shaft: at.time [s] and speed [rad/s]; one that is not finite neither raises nor clears.
  void update(const state::DriveState& shaft, const std::vector<CaptureSpeed>& captures,
              AlertList& alerts);
  /// What comes cannot be judged: delays are broken, and nothing is raised or cleared.
  void hold() {
    alarm_.hold();
    stands_ = false;
  }

 private:
  bool standsStill(double time, double speed, double scale);

  std::string system_;
  AlarmSettings settings_;
  ConditionAlarm alarm_;
  bool stands_ = false;
  double stood_since_ = 0.0;  ///< [s]
  double stood_at_ = 0.0;     ///< [rad/s]
};

}  // namespace whirl_twin

// Whether the states of one system can be trusted at all.
//
// ENERGY_RESIDUAL: a warning when the energy balance, change of energy against work and
// dissipation, is off by more than the setting in two messages running: the step is too long for
// the motion, or the model is wrong; of a system that `auto` steps, by more than its tolerance, if
// that is larger: then it keeps what the scene asks. Two, for the residual is relative to the
// largest energy so far, and after one step from rest there is next to none to compare with.
// ACCURACY_LOST: a warning when the error that the twin estimates of its own steps is above what
// the scene allows. NOT_FINITE: danger when the system was stopped because a state was no longer a
// finite number. STOPPED: danger when it was stopped for another cause, an implicit step that did
// not converge or a shaft at a speed that the step was not prepared for. They are two types, for
// they ask for different things: the first for another model or a look at its stability, the
// second for a shorter step or a smaller speed.
#pragma once

#include <string>

#include "integration/motion_state.h"
#include "monitoring/alarm_settings.h"
#include "monitoring/alert_list.h"
#include "monitoring/condition_alarm.h"

namespace whirl_twin {

class StateAlarm {
 public:
  StateAlarm(std::string system, const AlarmSettings& settings);

  /// Other settings from now on; what it knows of its cause, and for how long, stays.
  void set(const AlarmSettings& settings);
  /// residual [-] at time [s, simulated]; its sign does not matter. A NaN neither raises nor
  /// clears.
  void updateEnergy(double time, double residual, AlertList& alerts);

  /// estimate and tolerance [-] of the error over the horizon, at time [s, simulated]. A NaN
  /// neither raises nor clears.
  void updateAccuracy(double time, double estimate, double tolerance, AlertList& alerts);

  /// status: what the system reports at time [s, simulated]; text: its own sentence of why it
  /// stopped, which names the system. Clears clear_delay after the system runs again.
  void updateStopped(double time, StepStatus status, const std::string& text, AlertList& alerts);
  /// Its energy cannot be judged: delays are broken, and nothing is raised or cleared.
  void holdEnergy() { energy_alarm_.hold(); }

 private:
  std::string system_;
  AlarmSettings settings_;
  bool energy_above_ = false;
  double tolerance_ = 0.0;  // [-], of the error over the horizon, as last reported
  ConditionAlarm energy_alarm_;
  ConditionAlarm accuracy_alarm_;
  ConditionAlarm stopped_alarm_;
  const char* stopped_type_ = nullptr;  // of the alert that is raised
};

}  // namespace whirl_twin

// Whether the states of one system can be trusted at all.
//
// ENERGY_RESIDUAL: a warning when the energy balance, change of energy against work and
// dissipation, is off by more than the setting in two messages running: the step is too long for
// the motion, or the model is wrong. Two, for the residual is relative to the largest energy so
// far, and after one step from rest there is next to none to compare with.
// ACCURACY_LOST: a warning when the error that the twin estimates of its own steps is above what
// the scene allows. NOT_FINITE: danger when the system was stopped because a state was no longer a
// finite number.
#pragma once

#include <string>

#include "monitoring/alarm_settings.h"
#include "monitoring/alert_list.h"
#include "monitoring/condition_alarm.h"

namespace whirl_twin {

class StateAlarm {
 public:
  StateAlarm(std::string system, const AlarmSettings& settings);

  /// residual [-] at time [s, simulated]; its sign does not matter. A NaN neither raises nor
  /// clears.
  void updateEnergy(double time, double residual, AlertList& alerts);

  /// estimate and tolerance [-] of the error over the horizon, at time [s, simulated]. A NaN
  /// neither raises nor clears.
  void updateAccuracy(double time, double estimate, double tolerance, AlertList& alerts);

  /// stopped: the system reports that it stopped at time [s, simulated]; cause: the step and the
  /// values it names, for the text. Clears clear_delay after the system runs again.
  void updateFinite(double time, bool stopped, const std::string& cause, AlertList& alerts);

 private:
  std::string system_;
  AlarmSettings settings_;
  bool energy_above_ = false;
  ConditionAlarm energy_alarm_;
  ConditionAlarm accuracy_alarm_;
  ConditionAlarm not_finite_alarm_;
};

}  // namespace whirl_twin

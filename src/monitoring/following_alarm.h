// Alarms on what a follower knows of its machine (FollowState), each a warning:
//
//   MODEL_MISMATCH   the residuals are larger or smaller than the model allows, or last from sample
//                    to sample: beyond the limits that the message brings, which are those of a
//                    rate of false alarms (estimation/innovation_tests.h)
//   DRIFT            a parameter has become another (estimation/innovation_tests.h): which, from
//   where,
//                    to where, since when
//   SENSOR           a channel is silent, refused or invalid, or the shaft's angle is not known,
//   for
//                    longer than sensor_delay; the machine's clock is off, or gains, by more than
//                    clock_offset or clock_drift
//
// The audit of the decay (decay_alarm.h) raises MODEL_MISMATCH, too: while it does, it has the
// word.
#pragma once

#include <map>
#include <string>
#include <vector>

#include "messages/follow_state.h"
#include "monitoring/alarm_settings.h"
#include "monitoring/alert_list.h"
#include "monitoring/condition_alarm.h"

namespace whirl_twin {

class FollowingAlarm {
 public:
  /// has_shaft: the motion of a shaft enters the system's, and has to be known.
  FollowingAlarm(std::string system, bool has_shaft, const AlarmSettings& settings);

  /// Other settings from now on; what it knows of its causes, and for how long, stays.
  void set(const AlarmSettings& settings);
  /// mismatch_told: another alarm has raised MODEL_MISMATCH.
  void update(const state::FollowState& follow, bool mismatch_told, AlertList& alerts);

 private:
  void updateMismatch(const state::FollowState& follow, bool told, AlertList& alerts);
  void updateDrift(const state::FollowState& follow, AlertList& alerts);
  void updateSensors(const state::FollowState& follow, AlertList& alerts);
  state::Alert alertOf(const char* type, double time, const ConditionAlarm& alarm) const;
  /// What is wrong now with sensors and clocks: what, and how.
  std::map<std::string, std::string> wrong(const state::FollowState& follow) const;

  std::string system_;
  bool has_shaft_;
  double sensor_delay_ = 0.0;  // [s]
  double clock_offset_ = 0.0;  // [s]; 0: not watched
  double clock_drift_ = 0.0;   // [-]; 0: not watched
  ConditionAlarm mismatch_alarm_;
  ConditionAlarm drift_alarm_;
  ConditionAlarm sensor_alarm_;
  std::map<std::string, double> wrong_since_;  // [s], of what is wrong
};

}  // namespace whirl_twin

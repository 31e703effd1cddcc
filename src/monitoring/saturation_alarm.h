// What a controller could not do in the last second, and ACTUATOR_SATURATED: more than half of its
// outputs were beyond the limit or the slew of an actuator, second after second, for longer than
// `saturation_time`. Margins are those of a law whose outputs are given, and mean nothing there. A
// warning, of the controller by its name.
#pragma once

#include <cstdint>
#include <limits>
#include <optional>
#include <string>

#include "messages/controller_state.h"
#include "monitoring/alarm_settings.h"
#include "monitoring/alert_list.h"
#include "monitoring/condition_alarm.h"

namespace whirl_twin {

class SaturationAlarm {
 public:
  SaturationAlarm(std::string controller, const AlarmSettings& settings);

  /// Other settings from now on.
  void set(const AlarmSettings& settings);
  void update(const state::ControllerState& controller, AlertList& alerts);

  // Parts of the last whole second [-]; NaN before there was one.
  double saturated() const { return saturated_; }  ///< of its outputs
  double missed() const { return missed_; }        ///< of its samples

 private:
  /// What had been counted where a second began.
  struct Mark {
    double time = 0.0;  ///< [s], simulated
    std::int64_t samples = 0, saturated = 0, missed = 0;
  };

  std::string controller_;
  double allowed_ = 0.0;  // [s]; 0: not watched
  ConditionAlarm alarm_;
  std::optional<Mark> mark_;
  double saturated_ = std::numeric_limits<double>::quiet_NaN();
  double missed_ = std::numeric_limits<double>::quiet_NaN();
};

}  // namespace whirl_twin

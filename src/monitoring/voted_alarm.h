// VOTED_AMPLITUDE: so many of a machine's sources of vibration (stations of a shaft, rotors that
// are watched side by side) whirl wider than the alert level (a warning) or the danger level, 2 of
// 3 say. One sensor that lies raises nothing, and one that fails hides nothing:
//
//   danger, warning   at least `agree` sources are above that level
//   clear             even with the votes of those in doubt fewer than `agree` could be
//
// In doubt are sources within the hysteresis, and those that are not OK (data_quality.h): stale,
// not finite, out of range. They do not vote, and the alert and MonitorStatus name them.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "messages/states.h"
#include "monitoring/alarm_settings.h"
#include "monitoring/alert_list.h"
#include "monitoring/condition_alarm.h"
#include "monitoring/data_quality.h"
#include "monitoring/start_up.h"
#include "monitoring/whirl_vibration.h"

namespace whirl_twin {

class VotedAlarm {
 public:
  VotedAlarm(std::string system, const AlarmSettings& settings);

  /// Other settings from now on; sources that stay keep what they said.
  void set(const AlarmSettings& settings);
  bool listensTo(const std::string& source) const;
  /// The whirl of a source came at wall_time [s]; acceleration [rad/s^2] of the shaft.
  void take(const state::WhirlState& whirl, double acceleration, double wall_time,
            AlertList& alerts);
  /// Wall time passes [s]: whose source falls silent has no vote, and delays begin anew.
  void tick(double wall_time);
  /// Which sources do not vote, and why; "": all do. paused: the simulation says that it is held.
  std::string notOk(double wall_time, bool paused) const;

 private:
  struct Source {
    std::string name;
    DataQuality quality;
    WhirlVibration vibration = {};
    double amplitude = 0.0;  ///< [m]
    bool votes = false;
  };
  struct Count;
  Count count(double by) const;
  state::Alert alertOf(const state::WhirlState& whirl, double by, const Count& count) const;

  std::string system_;
  std::optional<Voting> voting_;
  std::vector<Source> sources_;
  double hysteresis_ = 0.0;
  StartUp start_up_;
  ConditionAlarm alarm_;
};

}  // namespace whirl_twin

// DATA_LOST: a system has fallen silent while others go on, or everybody has without a pause.
//
// One system's silence is judged when a state of another source arrives, by wall time, so that a
// paused simulation (everybody silent) is not mistaken for a lost system. When nothing at all
// arrives and the simulation does not say that it pauses, nothing is being watched: that is one
// alert, of the system "twin".
#pragma once

#include <string>
#include <vector>

#include "monitoring/alarm_settings.h"
#include "monitoring/alert_list.h"
#include "monitoring/condition_alarm.h"

namespace whirl_twin {

class DataLostAlarm {
 public:
  /// systems: those that are watched, whether or not they were ever heard.
  DataLostAlarm(const std::vector<std::string>& systems, const AlarmSettings& settings);

  /// Other settings from now on; what it knows of its cause, and for how long, stays.
  void set(const AlarmSettings& settings);
  /// A state of source arrived at wall_time [s, a clock that only goes forward], valid at
  /// time [s, simulated]. A source that is not watched (a drive) only shows that others go on.
  void received(const std::string& source, double wall_time, double time, AlertList& alerts);
  /// Time passes; paused: the simulation says that it is held.
  void tick(double wall_time, double time, bool paused, AlertList& alerts);

 private:
  struct Watch {
    std::string system;
    double heard_at;  ///< [s, wall]
    ConditionAlarm alarm;
  };
  void judge(Watch& watch, double wall_time, double time, AlertList& alerts) const;

  double timeout_;  ///< [s, wall]
  std::vector<Watch> watches_;
  ConditionAlarm everybody_;
  double last_arrival_;   ///< [s, wall], of any source
  double flowing_since_;  ///< [s, wall], states have arrived without a common gap since then
};

}  // namespace whirl_twin

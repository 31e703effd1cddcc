// LCM_LOST: the twin has messages that LCM cannot send (no multicast route, an interface gone), so
// that whoever listens there, and every log, has holes. A warning, of the system "twin".
#pragma once

#include <cstdint>
#include <optional>

#include "monitoring/alarm_settings.h"
#include "monitoring/alert_list.h"
#include "monitoring/condition_alarm.h"

namespace whirl_twin {

class LcmLostAlarm {
 public:
  explicit LcmLostAlarm(const AlarmSettings& settings);

  /// Other settings from now on.
  void set(const AlarmSettings& settings);
  /// failed: messages that could not be sent since the simulation was started, as it says at
  /// wall_time [s, a clock that only goes forward] and time [s, simulated]. The first that is heard
  /// is only what later ones are compared with: it may be of long ago.
  void update(double wall_time, double time, std::uint64_t failed, AlertList& alerts);

 private:
  ConditionAlarm alarm_;
  std::optional<std::uint64_t> before_;
};

}  // namespace whirl_twin

// One alarm as a state machine, as in machine-protection systems: a raise delay, a clear delay and
// a zone of hysteresis, so that it never flickers.
//
//   off --- raise condition held for raise_delay ---> active
//   active --- clear condition held for clear_delay without a break ---> off
//
// Between the two conditions lies kHold (hysteresis, or a value that cannot be judged): it neither
// raises nor clears, and it breaks both delays. A severity only goes up until the alarm clears.
//
// A warning whose cause was there a moment ago, though the alarm has cleared since, is a repeat and
// has a longer raise delay: a speed that ripples about a limit raises once. Danger waits for none.
#pragma once

#include <optional>
#include <string>

#include "messages/alert.h"
#include "monitoring/alarm_settings.h"

namespace whirl_twin {

/// The speed of a shaft [rad/s] in the text of an alert: rad/s, as in every message, and rpm for
/// operators.
std::string shaftSpeedText(double speed);

/// What the quantity watched says at one instant.
enum class AlarmCondition { kClear, kHold, kWarning, kDanger };

class ConditionAlarm {
 public:
  enum class Change { kNone, kRaised, kUpgraded, kCleared };

  struct Repeats {
    double window = 0.0;  ///< [s], a cause that comes back within is a repeat
    double delay = 0.0;   ///< [s], that a repeat has to hold before it raises
  };

  /// Delays in s of the clock that update() is given.
  explicit ConditionAlarm(AlarmDelays delays) : ConditionAlarm(delays.clear, delays.set) {}
  ConditionAlarm(AlarmDelays delays, Repeats repeats)
      : ConditionAlarm(delays.clear, delays.set, repeats) {}
  explicit ConditionAlarm(double clear_delay, double raise_delay = 0.0)
      : ConditionAlarm(clear_delay, raise_delay, Repeats{}) {}
  ConditionAlarm(double clear_delay, double raise_delay, Repeats repeats)
      : clear_delay_(clear_delay), raise_delay_(raise_delay), repeats_(repeats) {}

  /// Other delays from now on: what runs goes on, and is measured by them.
  void setDelays(AlarmDelays delays) {
    clear_delay_ = delays.clear;
    raise_delay_ = delays.set;
  }
  void setDelays(AlarmDelays delays, Repeats repeats) {
    setDelays(delays);
    repeats_ = repeats;
  }

  /// Steps to time [s]. A clock that was set back restarts the delays; a time that is not finite
  /// changes nothing.
  Change update(double time, AlarmCondition condition);

  /// Nothing can be judged at this instant: both delays are broken.
  void hold();

  /// Lets go at once, without the clear delay: another alarm has taken over.
  void clearNow();

  /// The cause is there at time [s], though another alarm speaks of it.
  void causeSeen(double time) { cause_seen_ = time; }
  /// The next cause is another one: no repeat.
  void forgetCause() { cause_seen_.reset(); }

  bool active() const { return active_; }

  /// The highest severity since it was raised.
  state::Severity severity() const { return severity_; }

 private:
  double clear_delay_;
  double raise_delay_;
  Repeats repeats_;
  bool active_ = false;
  state::Severity severity_ = state::Severity::kInfo;
  std::optional<double> raise_since_;
  std::optional<double> clear_since_;
  std::optional<double> cause_seen_;  ///< [s], when it last was there
  bool repeat_ = false;               ///< what has been raising since raise_since_
};

/// The condition calls for the alarm.
inline bool isRaising(AlarmCondition condition) {
  return condition >= AlarmCondition::kWarning;
}

}  // namespace whirl_twin

// One alarm as a state machine, as in machine-protection systems: a raise delay, a clear delay and
// a zone of hysteresis, so that it never flickers.
//
//   off --- raise condition held for raise_delay ---> active
//   active --- clear condition held for clear_delay without a break ---> off
//
// Between the two conditions lies kHold (hysteresis, or a value that cannot be judged): it neither
// raises nor clears, and it breaks both delays. A severity only goes up until the alarm clears.
#pragma once

#include <optional>

#include "messages/alert.h"

namespace whirl_twin {

/// What the quantity watched says at one instant.
enum class AlarmCondition { kClear, kHold, kWarning, kDanger };

class ConditionAlarm {
 public:
  enum class Change { kNone, kRaised, kUpgraded, kCleared };

  /// Delays in s of the clock that update() is given.
  explicit ConditionAlarm(double clear_delay, double raise_delay = 0.0)
      : clear_delay_(clear_delay), raise_delay_(raise_delay) {}

  /// Steps to time [s]. A clock that was set back restarts the delays; a time that is not finite
  /// changes nothing.
  Change update(double time, AlarmCondition condition);

  /// Lets go at once, without the clear delay: another alarm has taken over.
  void clearNow();

  bool active() const { return active_; }

  /// The highest severity since it was raised.
  state::Severity severity() const { return severity_; }

 private:
  double clear_delay_;
  double raise_delay_;
  bool active_ = false;
  state::Severity severity_ = state::Severity::kInfo;
  std::optional<double> raise_since_;
  std::optional<double> clear_since_;
};

/// The condition calls for the alarm.
inline bool isRaising(AlarmCondition condition) {
  return condition >= AlarmCondition::kWarning;
}

}  // namespace whirl_twin

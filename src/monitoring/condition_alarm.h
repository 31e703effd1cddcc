// One alarm as a state machine, as in machine-protection systems: a raise delay, a clear delay and
// a zone of hysteresis, so that it never flickers.
//
//   off --- raise condition held for raise_delay ---> active
//   active --- clear condition held for clear_delay without a break ---> off
//
// Between the two conditions lies kHold (hysteresis, or a value that cannot be evaluated): it
// neither raises nor clears, and it breaks both delays. A severity only goes up until the alarm
// clears.
//
// A warning whose cause was present a moment ago, though the alarm has cleared since, is a repeat
// and has a longer raise delay: a speed that ripples about a limit raises once. Danger waits for
// none.
//
// Alarm is such a state machine with the alert that it raises: an alarm on a quantity states its
// condition and the text of its alert, and Alarm raises, updates and clears it in the list.
#pragma once

#include <algorithm>
#include <optional>
#include <string>
#include <utility>

#include "messages/alert.h"
#include "monitoring/alarm_settings.h"
#include "monitoring/alert_list.h"

namespace whirl_twin {

/// The speed of a shaft [rad/s] in the text of an alert: rad/s, as in every message, and rpm for
/// operators.
std::string shaftSpeedText(double speed);

/// What the monitored quantity calls for at one instant.
enum class AlarmCondition { kClear, kHold, kWarning, kDanger };

class ConditionAlarm {
 public:
  enum class Change { kNone, kRaised, kUpgraded, kCleared };

  struct Repeats {
    double window = 0.0;  ///< [s], a cause that comes back within is a repeat
    double delay = 0.0;   ///< [s], that a repeat has to hold before it raises
  };

  /// Delays in s of the clock that update() is given.
  explicit ConditionAlarm(double clear_delay, double raise_delay = 0.0)
      : ConditionAlarm(clear_delay, raise_delay, Repeats{}) {}
  ConditionAlarm(double clear_delay, double raise_delay, Repeats repeats)
      : clear_delay_(clear_delay), raise_delay_(raise_delay), repeats_(repeats) {}

  /// New delays: those that run continue, and are measured by them.
  void setDelays(AlarmDelays delays) {
    clear_delay_ = delays.clear;
    raise_delay_ = delays.set;
  }
  void setRepeats(Repeats repeats) { repeats_ = repeats; }

  /// Steps to time [s]. A clock that was set back restarts the delays; a time that is not finite
  /// changes nothing.
  Change update(double time, AlarmCondition condition);

  /// Nothing can be evaluated at this instant: both delays are broken.
  void hold();

  /// Clears at once, without the clear delay: another alarm has taken over.
  void clearNow();

  /// The cause is present at time [s], though another alarm reports it.
  void causeSeen(double time) { cause_seen_ = time; }
  /// The next cause is a different one: no repeat.
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

/// Clear at or below `warning` less the hysteresis [-]; a NaN holds.
AlarmCondition levelCondition(double value, double warning, double danger, double hysteresis);

inline AlarmCondition warningIf(bool raises) {
  return raises ? AlarmCondition::kWarning : AlarmCondition::kClear;
}
inline AlarmCondition dangerIf(bool raises) {
  return raises ? AlarmCondition::kDanger : AlarmCondition::kClear;
}

/// One type of alert of one subject, a system or a controller.
class Alarm {
 public:
  Alarm(const std::string& subject, const char* type, SharedSettings settings)
      : Alarm(subject, type, std::move(settings), subject + ": ") {}
  /// prefix: of all its texts.
  Alarm(std::string subject, const char* type, SharedSettings settings, std::string prefix)
      : subject_(std::move(subject)),
        type_(type),
        prefix_(std::move(prefix)),
        settings_(std::move(settings)) {}

  const std::string& subject() const { return subject_; }
  const std::string& type() const { return type_; }
  const AlarmSettings& settings() const { return *settings_; }
  bool active() const { return state_.active(); }
  ConditionAlarm& state() { return state_; }

  /// [s], whatever the settings: a cause has to last so long.
  void setMinDelay(double delay) { min_delay_ = delay; }
  /// The input cannot be evaluated: delays are broken, and nothing is raised or cleared.
  void hold() { state_.hold(); }

  /// Steps to time [s, simulated]. `raised(alert)` writes text and numbers of an alert that has
  /// severity and time, and returns its decision (AlertList::raise); `cleared()` is the text of
  /// one that clears.
  template <class Raised, class Cleared>
  void update(double time, AlarmCondition condition, AlertList& alerts, const Raised& raised,
              const Cleared& cleared) {
    updateAt(time, time, condition, alerts, raised, cleared);
  }
  /// Likewise with delays by a clock of their own.
  template <class Raised, class Cleared>
  void updateAt(double clock, double time, AlarmCondition condition, AlertList& alerts,
                const Raised& raised, const Cleared& cleared) {
    if (step(clock, condition) == ConditionAlarm::Change::kCleared) {
      alerts.clear(subject_, type_, time, prefix_ + cleared());
    } else if (state_.active() && isRaising(condition)) {
      raise(time, alerts, raised);
    }
  }
  /// The state machine alone, with its present delays: no alert is raised or cleared.
  ConditionAlarm::Change step(double clock, AlarmCondition condition) {
    AlarmDelays delays = settings_->delaysOf(type_);
    delays.set = std::max(delays.set, min_delay_);
    state_.setDelays(delays);
    return state_.update(clock, condition);
  }
  /// Updates the alert of an active alarm, whatever its condition.
  template <class Raised>
  void raise(double time, AlertList& alerts, const Raised& raised) const {
    state::Alert alert;
    alert.system = subject_;
    alert.type = type_;
    alert.severity = state_.severity();
    alert.time = time;
    const std::string decision = raised(alert);
    alert.text.insert(0, prefix_);
    alerts.raise(std::move(alert), decision);
  }

 private:
  std::string subject_, type_, prefix_;
  SharedSettings settings_;
  double min_delay_ = 0.0;
  ConditionAlarm state_{0.0};
};

}  // namespace whirl_twin

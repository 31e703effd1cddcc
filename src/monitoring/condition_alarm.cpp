#include "monitoring/condition_alarm.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "algebra/constants.h"

namespace whirl_twin {
namespace {

// Time since `since` [s]; starts it when it is not running, or when the clock was set back.
double elapsed(std::optional<double>& since, double time) {
  if (!since || time < *since) {
    since = time;
  }
  return time - *since;
}

}  // namespace

std::string shaftSpeedText(double speed) {
  return fmt::format("{:.1f} rad/s ({:.0f} rpm)", speed, speed * 30.0 / kPi);
}

AlarmCondition levelCondition(double value, double warning, double danger, double hysteresis) {
  return value > danger                          ? AlarmCondition::kDanger
         : value > warning                       ? AlarmCondition::kWarning
         : value <= warning * (1.0 - hysteresis) ? AlarmCondition::kClear
                                                 : AlarmCondition::kHold;
}

ConditionAlarm::Change ConditionAlarm::update(double time, AlarmCondition condition) {
  if (!std::isfinite(time)) {
    return Change::kNone;
  }
  if (condition != AlarmCondition::kClear) {
    clear_since_.reset();
  }
  if (!isRaising(condition)) {
    raise_since_.reset();
    if (!active_ || condition == AlarmCondition::kHold ||
        elapsed(clear_since_, time) < clear_delay_) {
      return Change::kNone;
    }
    clearNow();
    return Change::kCleared;
  }

  if (!raise_since_) {
    repeat_ = cause_seen_ && time >= *cause_seen_ && time - *cause_seen_ < repeats_.window;
  }
  cause_seen_ = time;
  const state::Severity severity =
      condition == AlarmCondition::kDanger ? state::Severity::kDanger : state::Severity::kWarning;
  if (active_) {
    if (severity <= severity_) {
      return Change::kNone;
    }
    severity_ = severity;
    return Change::kUpgraded;
  }
  const double held = elapsed(raise_since_, time);
  const bool waits = repeat_ && condition != AlarmCondition::kDanger;
  if (held < (waits ? std::max(raise_delay_, repeats_.delay) : raise_delay_)) {
    return Change::kNone;
  }
  active_ = true;
  severity_ = severity;
  repeat_ = false;
  return Change::kRaised;
}

void ConditionAlarm::hold() {
  raise_since_.reset();
  clear_since_.reset();
}

void ConditionAlarm::clearNow() {
  active_ = false;
  severity_ = state::Severity::kInfo;
  raise_since_.reset();
  clear_since_.reset();
}

}  // namespace whirl_twin

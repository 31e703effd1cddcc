#include "monitoring/loop_alarm.h"

#include <fmt/format.h>

#include <cmath>
#include <utility>

#include "analysis/routh.h"
#include "messages/alert.h"

namespace whirl_twin {

namespace {

std::string loopText(const state::ControllerMargins& margins, double limit) {
  if (std::isinf(margins.sensitivity_peak)) {
    return fmt::format("controller {}: its loop is {}, sensitivity unbounded", margins.controller,
                       margins.verdict_name);
  }
  return fmt::format(
      "controller {}: sensitivity {:.3g} at {:.4g} rad/s is above {:g}, zone {}; gain margin "
      "{:.3g} times, delay margin {:.3g} s",
      margins.controller, margins.sensitivity_peak, margins.peak_frequency, limit, margins.zone,
      margins.gain_margin, margins.delay_margin);
}

}  // namespace

LoopAlarm::LoopAlarm(std::string controller, const AlarmSettings& settings)
    : controller_(std::move(controller)), alarm_(settings.delaysOf(alert_type::kLoopSensitivity)) {
  set(settings);
}

void LoopAlarm::set(const AlarmSettings& settings) {
  limit_ = settings.sensitivity_warning;
  hysteresis_ = settings.hysteresis;
  alarm_.setDelays(settings.delaysOf(alert_type::kLoopSensitivity));
}

AlarmCondition LoopAlarm::conditionOf(const state::ControllerMargins& margins) const {
  if (limit_ == 0.0) {
    return AlarmCondition::kClear;
  }
  const auto verdict = static_cast<Verdict>(margins.verdict);
  if (verdict == Verdict::kUnstable || verdict == Verdict::kUncertain ||
      std::isnan(margins.sensitivity_peak)) {
    return AlarmCondition::kHold;
  }
  return margins.sensitivity_peak > limit_                         ? AlarmCondition::kWarning
         : margins.sensitivity_peak < (1.0 - hysteresis_) * limit_ ? AlarmCondition::kClear
                                                                   : AlarmCondition::kHold;
}

void LoopAlarm::update(const state::ControllerMargins& margins, AlertList& alerts) {
  const AlarmCondition condition = conditionOf(margins);
  if (alarm_.update(margins.at.time, condition) == ConditionAlarm::Change::kCleared) {
    alerts.clear(controller_, alert_type::kLoopSensitivity, margins.at.time,
                 fmt::format("controller {}: sensitivity {:.3g}, zone {}", controller_,
                             margins.sensitivity_peak, margins.zone));
  } else if (alarm_.active() && isRaising(condition)) {
    state::Alert alert;
    alert.system = controller_;
    alert.type = alert_type::kLoopSensitivity;
    alert.severity = alarm_.severity();
    alert.time = margins.at.time;
    alert.speed = margins.speed;
    alert.text = loopText(margins, limit_);
    alerts.raise(std::move(alert), margins.zone);
  }
}

}  // namespace whirl_twin

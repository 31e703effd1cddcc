#include "monitoring/state_alarm.h"

#include <fmt/format.h>

#include <cmath>
#include <utility>

#include "messages/alert.h"

namespace whirl_twin {

StateAlarm::StateAlarm(std::string system, const AlarmSettings& settings)
    : system_(std::move(system)),
      settings_(settings),
      energy_alarm_(settings.delaysOf(alert_type::kEnergyResidual)),
      accuracy_alarm_(settings.delaysOf(alert_type::kAccuracyLost)),
      stopped_alarm_(settings.delaysOf(alert_type::kStopped)) {}

void StateAlarm::set(const AlarmSettings& settings) {
  settings_ = settings;
  energy_alarm_.setDelays(settings.delaysOf(alert_type::kEnergyResidual));
  accuracy_alarm_.setDelays(settings.delaysOf(alert_type::kAccuracyLost));
  stopped_alarm_.setDelays(settings.delaysOf(alert_type::kStopped));
}

void StateAlarm::updateEnergy(double time, double residual, AlertList& alerts) {
  const double limit = std::fmax(settings_.energy_residual, tolerance_);
  AlarmCondition condition = AlarmCondition::kHold;
  const bool above = std::abs(residual) > limit;
  if (above && energy_above_) {
    condition = AlarmCondition::kWarning;
  } else if (std::abs(residual) <= limit * (1.0 - settings_.hysteresis)) {
    condition = AlarmCondition::kClear;
  }
  energy_above_ = above;
  if (energy_alarm_.update(time, condition) == ConditionAlarm::Change::kCleared) {
    alerts.clear(system_, alert_type::kEnergyResidual, time,
                 fmt::format("{}: energy residual normal again, {:.2g}", system_, residual));
  } else if (energy_alarm_.active() && isRaising(condition)) {
    state::Alert alert;
    alert.system = system_;
    alert.type = alert_type::kEnergyResidual;
    alert.severity = energy_alarm_.severity();
    alert.time = time;
    alert.text = fmt::format("{}: energy residual {:.2g}, above {:g}: shorten the step", system_,
                             residual, limit);
    alerts.raise(std::move(alert), "energy residual");
  }
}

void StateAlarm::updateAccuracy(double time, double estimate, double tolerance, AlertList& alerts) {
  tolerance_ = tolerance;  // NaN: not chosen by `auto`
  AlarmCondition condition = AlarmCondition::kHold;
  if (estimate > tolerance) {
    condition = AlarmCondition::kWarning;
  } else if (estimate <= tolerance * (1.0 - settings_.hysteresis)) {
    condition = AlarmCondition::kClear;
  }
  if (accuracy_alarm_.update(time, condition) == ConditionAlarm::Change::kCleared) {
    alerts.clear(system_, alert_type::kAccuracyLost, time,
                 fmt::format("{}: error within the tolerance again, {:.1g}", system_, estimate));
  } else if (accuracy_alarm_.active() && isRaising(condition)) {
    state::Alert alert;
    alert.system = system_;
    alert.type = alert_type::kAccuracyLost;
    alert.severity = accuracy_alarm_.severity();
    alert.time = time;
    alert.text = fmt::format(
        "{}: error about {:.1g} over the horizon, above the tolerance {:g}: shorten the step",
        system_, estimate, tolerance);
    alerts.raise(std::move(alert), "accuracy");
  }
}

void StateAlarm::updateStopped(double time, StepStatus status, const std::string& why,
                               AlertList& alerts) {
  // Over the network it may come without.
  const std::string text = why.empty() ? system_ + ": stopped, cause not reported" : why;
  const bool stopped = status != StepStatus::kOk;
  const AlarmCondition condition = stopped ? AlarmCondition::kDanger : AlarmCondition::kClear;
  const bool cleared = stopped_alarm_.update(time, condition) == ConditionAlarm::Change::kCleared;
  const char* const type =
      status == StepStatus::kNotFinite ? alert_type::kNotFinite : alert_type::kStopped;
  if (stopped_type_ != nullptr && (cleared || (stopped && type != stopped_type_))) {
    alerts.clear(system_, stopped_type_, time,
                 cleared ? fmt::format("{}: runs again", system_) : text);
    stopped_type_ = nullptr;
  }
  if (stopped_alarm_.active() && stopped) {
    stopped_type_ = type;
    state::Alert alert;
    alert.system = system_;
    alert.type = type;
    alert.severity = stopped_alarm_.severity();
    alert.time = time;
    alert.text = text;
    alerts.raise(std::move(alert), text);
  }
}

}  // namespace whirl_twin

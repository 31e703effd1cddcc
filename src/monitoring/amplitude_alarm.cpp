#include "monitoring/amplitude_alarm.h"

#include <fmt/format.h>

#include <cmath>
#include <utility>

#include "messages/alert.h"

namespace whirl_twin {
AmplitudeAlarm::AmplitudeAlarm(std::string system, const AlarmSettings& settings)
    : system_(std::move(system)),
      start_up_(settings),
      alarm_(settings.delaysOf(alert_type::kWhirlAmplitude)) {
  set(settings);
}

void AmplitudeAlarm::set(const AlarmSettings& settings) {
  hysteresis_ = settings.hysteresis;
  start_up_.set(settings);
  alarm_.setDelays(settings.delaysOf(alert_type::kWhirlAmplitude));
  const auto levels = settings.amplitude.find(system_);
  levels_ = levels != settings.amplitude.end() ? levels->second : AmplitudeLevels();
  has_levels_ = levels != settings.amplitude.end();
}

void AmplitudeAlarm::update(double time, double amplitude, double speed, double acceleration,
                            AlertList& alerts) {
  if (!has_levels_ && !alarm_.active()) {  // without levels it can only clear
    return;
  }
  if (!std::isfinite(amplitude) || !std::isfinite(speed) || !std::isfinite(time)) {
    alarm_.update(time, AlarmCondition::kHold);
    return;
  }
  const double by = start_up_.multiplier(time, speed, acceleration);
  const double alert_level = by * levels_.alertAt(speed);
  const double danger_level = by * levels_.dangerAt(speed);
  AlarmCondition condition = AlarmCondition::kHold;
  if (amplitude > danger_level) {
    condition = AlarmCondition::kDanger;
  } else if (amplitude > alert_level) {
    condition = AlarmCondition::kWarning;
  } else if (amplitude <= std::fmin(alert_level, danger_level) * (1.0 - hysteresis_)) {
    condition = AlarmCondition::kClear;
  }
  if (alarm_.update(time, condition) == ConditionAlarm::Change::kCleared) {
    alerts.clear(system_, alert_type::kWhirlAmplitude, time,
                 fmt::format("{}: vibration back to {:.3g} mm 0-peak at {}", system_,
                             1.0e3 * amplitude, shaftSpeedText(speed)));
  } else if (alarm_.active() && isRaising(condition)) {
    const bool danger = condition == AlarmCondition::kDanger;
    state::Alert alert;
    alert.system = system_;
    alert.type = alert_type::kWhirlAmplitude;
    alert.severity = alarm_.severity();
    alert.time = time;
    alert.speed = speed;
    alert.acceleration = acceleration;
    alert.amplitude = amplitude;
    alert.amplitude_limit = danger ? danger_level : alert_level;
    alert.text = fmt::format(
        "{}: vibration {:.3g} mm 0-peak at {}, above the {} level {:.3g} mm{}: {}", system_,
        1.0e3 * amplitude, shaftSpeedText(speed), danger ? "danger" : "alert",
        1.0e3 * alert.amplitude_limit,
        by != 1.0 ? fmt::format(" (multiplied by {:g} during start-up)", by) : "",
        danger ? "stop the machine or change the speed" : "find the cause or change the speed");
    alerts.raise(std::move(alert), danger ? "danger" : "alert");
  }
}

}  // namespace whirl_twin

#include "monitoring/saturation_alarm.h"

#include <fmt/format.h>

#include <cmath>
#include <utility>

#include "messages/alert.h"

namespace whirl_twin {

namespace {

constexpr double kWindow = 1.0;            // s, simulated
constexpr double kMaxSaturatedPart = 0.5;  // of the outputs

AlarmDelays delaysOf(const AlarmSettings& settings) {
  AlarmDelays delays = settings.delaysOf(alert_type::kActuatorSaturated);
  delays.set = std::fmax(delays.set, settings.saturation_time - kWindow);
  return delays;
}

}  // namespace

SaturationAlarm::SaturationAlarm(std::string controller, const AlarmSettings& settings)
    : controller_(std::move(controller)),
      allowed_(settings.saturation_time),
      alarm_(delaysOf(settings)) {}

void SaturationAlarm::set(const AlarmSettings& settings) {
  allowed_ = settings.saturation_time;
  alarm_.setDelays(delaysOf(settings));
}

void SaturationAlarm::update(const state::ControllerState& controller, AlertList& alerts) {
  const double time = controller.at.time;
  const Mark now{time, controller.samples, controller.saturated, controller.missed};
  if (!mark_ || time < mark_->time || now.samples < mark_->samples) {  // played a second time
    mark_ = now;
    return;
  }
  const auto samples = static_cast<double>(now.samples - mark_->samples);
  if (time - mark_->time < kWindow || samples == 0.0) {
    return;
  }
  const auto outputs = samples * static_cast<double>(controller.output.size());
  saturated_ = static_cast<double>(now.saturated - mark_->saturated) / outputs;
  missed_ = static_cast<double>(now.missed - mark_->missed) / samples;
  mark_ = now;

  const bool warn = allowed_ > 0.0 && saturated_ > kMaxSaturatedPart;
  const AlarmCondition condition = warn ? AlarmCondition::kWarning : AlarmCondition::kClear;
  if (alarm_.update(time, condition) == ConditionAlarm::Change::kCleared) {
    alerts.clear(controller_, alert_type::kActuatorSaturated, time,
                 fmt::format("controller {}: its actuators are no longer saturated", controller_));
  } else if (alarm_.active() && warn) {
    state::Alert alert;
    alert.system = controller_;
    alert.type = alert_type::kActuatorSaturated;
    alert.severity = alarm_.severity();
    alert.time = time;
    alert.text = fmt::format(
        "controller {}: actuators saturated for {:g} s, less than half of the command applied "
        "({:.0f} % of the last second missing): its margins do not hold",
        controller_, allowed_, 100.0 * saturated_);
    alerts.raise(std::move(alert), "saturated");
  }
}

}  // namespace whirl_twin

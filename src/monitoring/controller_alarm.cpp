#include "monitoring/controller_alarm.h"

#include <fmt/format.h>

#include <utility>

#include "messages/alert.h"

namespace whirl_twin {

ControllerAlarm::ControllerAlarm(std::string controller, const AlarmSettings& settings)
    : controller_(std::move(controller)), alarm_(settings.delaysOf(alert_type::kControllerLost)) {}

void ControllerAlarm::set(const AlarmSettings& settings) {
  alarm_.setDelays(settings.delaysOf(alert_type::kControllerLost));
}

void ControllerAlarm::update(double time, bool lost, AlertList& alerts) {
  const AlarmCondition condition = lost ? AlarmCondition::kDanger : AlarmCondition::kClear;
  if (alarm_.update(time, condition) == ConditionAlarm::Change::kCleared) {
    alerts.clear(controller_, alert_type::kControllerLost, time,
                 fmt::format("controller {}: answers again", controller_));
  } else if (alarm_.active() && lost) {
    state::Alert alert;
    alert.system = controller_;
    alert.type = alert_type::kControllerLost;
    alert.severity = alarm_.severity();
    alert.time = time;
    alert.text = fmt::format(
        "controller {}: no answer from its process within its timeout; on_timeout applies",
        controller_);
    alerts.raise(std::move(alert), "no answer");
  }
}

}  // namespace whirl_twin

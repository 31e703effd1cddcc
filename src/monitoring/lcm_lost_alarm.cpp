#include "monitoring/lcm_lost_alarm.h"

#include <fmt/format.h>

#include <utility>

#include "messages/alert.h"

namespace whirl_twin {

LcmLostAlarm::LcmLostAlarm(const AlarmSettings& settings)
    : alarm_(settings.delaysOf(alert_type::kLcmLost)) {}

void LcmLostAlarm::set(const AlarmSettings& settings) {
  alarm_.setDelays(settings.delaysOf(alert_type::kLcmLost));
}

void LcmLostAlarm::update(double wall_time, double time, std::uint64_t failed, AlertList& alerts) {
  const bool losing = before_ && failed > *before_;
  const std::uint64_t lost = losing ? failed - *before_ : 0;
  before_ = failed;
  const AlarmCondition condition = losing ? AlarmCondition::kWarning : AlarmCondition::kClear;
  if (alarm_.update(wall_time, condition) == ConditionAlarm::Change::kCleared) {
    alerts.clear(
        alert_type::kEverybody, alert_type::kLcmLost, time,
        fmt::format("LCM sends again; {} messages were lost since the twin was started", failed));
  } else if (alarm_.active() && losing) {
    state::Alert alert;
    alert.system = alert_type::kEverybody;
    alert.type = alert_type::kLcmLost;
    alert.severity = alarm_.severity();
    alert.time = time;
    alert.text = fmt::format(
        "LCM could not send {} messages, {} since the twin was started: LCM logs and subscribers "
        "miss them; check the multicast route",
        lost, failed);
    alerts.raise(std::move(alert), "LCM");
  }
}

}  // namespace whirl_twin

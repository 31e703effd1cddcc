#include "monitoring/validity_alarm.h"

#include <fmt/format.h>

#include <exception>
#include <utility>

#include "messages/alert.h"

namespace whirl_twin {

ValidityAlarm::ValidityAlarm(std::string system, std::shared_ptr<const Dynamics> dynamics,
                             const AlarmSettings& settings)
    : system_(std::move(system)),
      dynamics_(std::move(dynamics)),
      has_conditions_(hasConditions(*dynamics_)),
      alarm_(settings.delaysOf(alert_type::kModelInvalid)) {}

void ValidityAlarm::set(const AlarmSettings& settings) {
  alarm_.setDelays(settings.delaysOf(alert_type::kModelInvalid));
}

void ValidityAlarm::setDynamics(std::shared_ptr<const Dynamics> dynamics) {
  dynamics_ = std::move(dynamics);
  has_conditions_ = hasConditions(*dynamics_);
}

void ValidityAlarm::update(const Eigen::VectorXd& q, const Eigen::VectorXd& v,
                           const Moment<double>& at, AlertList& alerts) {
  if (!has_conditions_) {
    return;
  }
  std::string broken;
  try {
    broken = brokenText(validity(*dynamics_, q, v, at), Margins::kLeftOut);
  } catch (const std::exception&) {  // numbers beyond the range of double: nothing is known
    hold();
    return;
  }
  const AlarmCondition condition =
      broken.empty() ? AlarmCondition::kClear : AlarmCondition::kWarning;
  if (alarm_.update(at.time, condition) == ConditionAlarm::Change::kCleared) {
    alerts.clear(system_, alert_type::kModelInvalid, at.time,
                 fmt::format("{}: its equations are valid again", system_));
  } else if (alarm_.active() && !broken.empty()) {
    state::Alert alert;
    alert.system = system_;
    alert.type = alert_type::kModelInvalid;
    alert.severity = alarm_.severity();
    alert.time = at.time;
    alert.text = fmt::format("{}: its equations are not valid: {}", system_, broken);
    alerts.raise(std::move(alert), broken);
  }
}

}  // namespace whirl_twin

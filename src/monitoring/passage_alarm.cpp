#include "monitoring/passage_alarm.h"

#include <fmt/format.h>

#include <utility>

#include "messages/alert.h"
#include "scene/weak_passage.h"

namespace whirl_twin {
namespace {

using state::Supervision;

std::string textOf(Supervision supervision) {
  switch (supervision) {
    case Supervision::kRetreating:
      return "resonance capture: a resonance absorbs all the motor's torque; it retreats below the "
             "barred range";
    case Supervision::kTryingAgain:
      return "tries again after a resonance capture, with the motor's full torque";
    case Supervision::kGivenUp:
      return "gave up after its last attempt, each ended in a resonance capture; it stays below "
             "the barred range";
    case Supervision::kRefused:
      return "does not start: the motor's torque is too low for a resonance; it stays below the "
             "barred range";
    case Supervision::kNone:
      break;
  }
  return "passed the resonance";
}

std::string refusalOf(const ControllerSpec& controller) {
  for (const WeakPassage& passage : controller.weak_passages) {
    if (!passage.tried) {
      return ": " + describe(passage);
    }
  }
  return "";
}

}  // namespace

PassageAlarm::PassageAlarm(const ControllerSpec& controller, const AlarmSettings& settings)
    : controller_(controller.name),
      refusal_(refusalOf(controller)),
      alarm_(settings.delaysOf(alert_type::kResonanceNotPassed)) {}

void PassageAlarm::restart(const AlarmSettings& settings) {
  alarm_ = ConditionAlarm(settings.delaysOf(alert_type::kResonanceNotPassed));
}

void PassageAlarm::set(const AlarmSettings& settings) {
  alarm_.setDelays(settings.delaysOf(alert_type::kResonanceNotPassed));
}

void PassageAlarm::update(const state::ControllerState& controller, AlertList& alerts) {
  const Supervision now = controller.supervision;
  const AlarmCondition condition = now == Supervision::kNone         ? AlarmCondition::kClear
                                   : now == Supervision::kRetreating ? AlarmCondition::kDanger
                                                                     : AlarmCondition::kWarning;
  const std::string text = fmt::format("controller {}: {}{}", controller_, textOf(now),
                                       now == Supervision::kRefused ? refusal_ : "");
  const double time = controller.at.time;
  if (alarm_.update(time, condition) == ConditionAlarm::Change::kCleared) {
    alerts.clear(controller_, alert_type::kResonanceNotPassed, time, text);
  } else if (alarm_.active() && isRaising(condition)) {
    state::Alert alert;
    alert.system = controller_;
    alert.type = alert_type::kResonanceNotPassed;
    alert.severity = alarm_.severity();
    alert.time = time;
    alert.text = text;
    alerts.raise(std::move(alert), fmt::format("supervision {}", static_cast<int>(now)));
  }
}

}  // namespace whirl_twin

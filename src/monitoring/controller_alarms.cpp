#include "monitoring/controller_alarms.h"

#include <fmt/format.h>

#include <cmath>

#include "algebra/constants.h"
#include "analysis/routh.h"
#include "messages/alert.h"
#include "scene/resonance_passage_check.h"

namespace whirl_twin {
namespace {

using state::Supervision;

constexpr double kWindow = 1.0;            // s, simulated
constexpr double kMaxSaturatedPart = 0.5;  // of the outputs

std::string passageText(Supervision supervision) {
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

std::string prefixOf(const ControllerSpec& controller) {
  return "controller " + controller.name + ": ";
}

AlarmCondition loopCondition(const state::ControllerMargins& margins, double limit,
                             double hysteresis) {
  if (limit == 0.0) {
    return AlarmCondition::kClear;
  }
  const auto verdict = static_cast<Verdict>(margins.verdict);
  return verdict == Verdict::kUnstable || verdict == Verdict::kUncertain
             ? AlarmCondition::kHold
             : levelCondition(margins.sensitivity_peak, limit, kInfinity, hysteresis);
}

}  // namespace

ControllerAlarms::ControllerAlarms(const ControllerSpec& controller, const SharedSettings& settings)
    : settings_(settings),
      lost_(controller.name, alert_type::kControllerLost, settings, prefixOf(controller)),
      loop_(controller.name, alert_type::kLoopSensitivity, settings, prefixOf(controller)),
      saturation_(controller.name, alert_type::kActuatorSaturated, settings, prefixOf(controller)),
      passage_(controller.name, alert_type::kResonanceNotPassed, settings, prefixOf(controller)) {
  for (const ResonancePassageCheck& passage : controller.weak_passages) {
    if (!passage.tried && refusal_.empty()) {
      refusal_ = ": " + describe(passage);
    }
  }
}

void ControllerAlarms::update(const state::ControllerState& controller, AlertList& alerts) {
  lost_.update(
      controller.at.time, dangerIf(controller.lost), alerts,
      [&](state::Alert& alert) {
        alert.text = "no answer from its process within its timeout; on_timeout applies";
        return "no answer";
      },
      [&] { return "answers again"; });
  updateSaturation(controller, alerts);
  updatePassage(controller, alerts);
}

void ControllerAlarms::updateSaturation(const state::ControllerState& controller,
                                        AlertList& alerts) {
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

  const bool warn = settings_->saturation_time > 0.0 && saturated_ > kMaxSaturatedPart;
  saturation_.setMinDelay(settings_->saturation_time - kWindow);
  saturation_.update(
      time, warningIf(warn), alerts,
      [&](state::Alert& alert) {
        alert.text = fmt::format(
            "actuators saturated for {:g} s, less than half of the command applied "
            "({:.0f} % of the last second missing): its margins do not hold",
            settings_->saturation_time, 100.0 * saturated_);
        return "saturated";
      },
      [&] { return "its actuators are no longer saturated"; });
}

void ControllerAlarms::updatePassage(const state::ControllerState& controller, AlertList& alerts) {
  const Supervision now = controller.supervision;
  const AlarmCondition condition = now == Supervision::kRetreating
                                       ? AlarmCondition::kDanger
                                       : warningIf(now != Supervision::kNone);
  const std::string text =
      fmt::format("{}{}", passageText(now), now == Supervision::kRefused ? refusal_ : "");
  passage_.update(
      controller.at.time, condition, alerts,
      [&](state::Alert& alert) {
        alert.text = text;
        return fmt::format("supervision {}", static_cast<int>(now));
      },
      [&] { return text; });
}

void ControllerAlarms::update(const state::ControllerMargins& margins, AlertList& alerts) {
  loop_.update(
      margins.at.time,
      loopCondition(margins, settings_->sensitivity_warning, settings_->hysteresis), alerts,
      [&](state::Alert& alert) {
        alert.speed = margins.speed;
        alert.text =
            std::isinf(margins.sensitivity_peak)
                ? fmt::format("its loop is {}, sensitivity unbounded", margins.verdict_name)
                : fmt::format(
                      "sensitivity {:.3g} at {:.4g} rad/s is above {:g}, zone {}; "
                      "gain margin {:.3g} times, delay margin {:.3g} s",
                      margins.sensitivity_peak, margins.peak_frequency,
                      settings_->sensitivity_warning, margins.zone, margins.gain_margin,
                      margins.delay_margin);
        return margins.zone;
      },
      [&] {
        return fmt::format("sensitivity {:.3g}, zone {}", margins.sensitivity_peak, margins.zone);
      });
}

}  // namespace whirl_twin

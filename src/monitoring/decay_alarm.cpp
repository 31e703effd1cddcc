#include "monitoring/decay_alarm.h"

#include <fmt/format.h>

#include <cmath>
#include <optional>
#include <utility>

#include "algebra/constants.h"
#include "analysis/routh.h"
#include "control/shaft_angle.h"
#include "messages/alert.h"

namespace whirl_twin {

namespace {

/// Standard deviations of the measured rate: once in some ten thousand records by chance, with the
/// few parts that its deviation is told from.
constexpr double kApart = 6.0;
constexpr double kSameDecayDeviations = 4.0;
/// Of the larger of the two rates, less than which is no matter.
constexpr double kMatters = 0.25;
constexpr double kLargestAngle = 1.0e15;  // rad, beyond which a double holds no phase

}  // namespace

DecayAlarm::DecayAlarm(std::string system, const AlarmSettings& settings)
    : system_(std::move(system)),
      record_(settings.decay_audit),
      audit_(settings.decay_audit),
      alarm_(settings.delaysOf(alert_type::kModelMismatch)),
      model_(kNaN) {}

void DecayAlarm::set(const AlarmSettings& settings) {
  alarm_.setDelays(settings.delaysOf(alert_type::kModelMismatch));
  if (settings.decay_audit != record_) {
    record_ = settings.decay_audit;
    audit_ = DecayAudit(record_);
  }
}

void DecayAlarm::hold() {
  audit_.clear();
  alarm_.hold();
}

void DecayAlarm::update(const state::StabilityMargin& margin) {
  const bool stable = margin.verdict == static_cast<std::uint8_t>(Verdict::kAsymptoticallyStable);
  model_ = stable ? margin.decay_rate : kNaN;
}

void DecayAlarm::update(const state::WhirlState& whirl, AlertList& alerts) {
  if (record_ <= 0.0) {
    if (alarm_.active()) {
      alarm_.clearNow();
      alerts.clear(system_, alert_type::kModelMismatch, whirl.at.time,
                   fmt::format("{}: its decay rate is no longer measured", system_));
    }
    return;
  }
  if (!(std::fabs(whirl.shaft_angle) <= kLargestAngle)) {
    audit_.clear();
    return;
  }
  const std::int64_t passed = whirl.at.step - last_;
  index_ += passed == stride_ ? 1 : 2;  // another distance is a hole
  stride_ = passed;
  last_ = whirl.at.step;
  const ShaftAngle angle = shaftAngle(whirl.shaft_angle);
  const std::optional<AuditedDecay> measured = audit_.take(
      {index_, whirl.at.time, angle.turns, angle.remainder, whirl.speed, whirl.x, whirl.y});
  if (measured && std::isfinite(model_)) {
    judge(*measured, whirl.speed, alerts);
  }
}

void DecayAlarm::judge(const AuditedDecay& measured, double speed, AlertList& alerts) {
  const double apart = std::fabs(measured.decay_rate - model_);
  const double larger = std::fmax(std::fabs(measured.decay_rate), std::fabs(model_));
  AlarmCondition condition = AlarmCondition::kHold;
  if (apart > kApart * measured.deviation && apart > kMatters * larger) {
    condition = AlarmCondition::kWarning;
  } else if (apart < kSameDecayDeviations * measured.deviation || apart < kMatters * larger) {
    condition = AlarmCondition::kClear;
  }
  const std::string rates = fmt::format(
      "at {} the mode at {:.1f} rad/s has a decay rate of {:.3g} +- {:.2g} 1/s, in the model "
      "{:.3g} 1/s",
      shaftSpeedText(speed), std::fabs(measured.frequency), measured.decay_rate, measured.deviation,
      model_);
  if (alarm_.update(measured.time, condition) == ConditionAlarm::Change::kCleared) {
    alerts.clear(system_, alert_type::kModelMismatch, measured.time,
                 fmt::format("{}: {}", system_, rates));
  } else if (alarm_.active() && isRaising(condition)) {
    state::Alert alert;
    alert.system = system_;
    alert.type = alert_type::kModelMismatch;
    alert.severity = alarm_.severity();
    alert.time = measured.time;
    alert.speed = speed;
    alert.decay_rate = measured.decay_rate;
    alert.text = fmt::format(
        "{}: {}: the margins of the model do not apply to the machine; {}", system_, rates,
        measured.decay_rate < model_ ? "it is closer to instability" : "find out what changed");
    alerts.raise(std::move(alert), measured.decay_rate < model_ ? "less" : "more");
  }
}

}  // namespace whirl_twin

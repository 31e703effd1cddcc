#include "monitoring/stability_alarm.h"

#include <fmt/format.h>

#include <cmath>
#include <cstdint>
#include <utility>

#include "analysis/routh.h"
#include "messages/alert.h"

namespace whirl_twin {
namespace {

// A number that is no verdict counts as an uncertain one.
AlarmCondition verdictCondition(std::uint8_t verdict) {
  switch (static_cast<Verdict>(verdict)) {
    case Verdict::kAsymptoticallyStable:
    case Verdict::kMarginal:
      return AlarmCondition::kClear;
    case Verdict::kRepeatedImaginary:
      return AlarmCondition::kWarning;
    case Verdict::kUnstable:
      return AlarmCondition::kDanger;
    default:
      return AlarmCondition::kHold;
  }
}

/// A rotor and what it is reduced to on different sides of the limit are a warning.
AlarmCondition verdictCondition(const state::StabilityMargin& margin) {
  return margin.reduction_disagrees ? AlarmCondition::kWarning : verdictCondition(margin.verdict);
}

/// Of which motion a verdict is, where that is no equilibrium.
const char* aboutText(const state::StabilityMargin& margin) {
  using About = state::StabilityMargin::About;
  return margin.judged_about == About::kPeriodicMotion ? " (its periodic motion)"
         : margin.judged_about == About::kMeanLoads    ? " (under its mean loads)"
                                                       : "";
}

/// What grows: roots of the characteristic polynomial, or multipliers of a periodic motion.
std::string growingText(const state::StabilityMargin& margin) {
  const char* const many = margin.right == 1 ? "" : "s";
  return margin.judged_about == state::StabilityMargin::About::kPeriodicMotion
             ? fmt::format("{} Floquet multiplier{} outside the unit circle", margin.right, many)
             : fmt::format("{} root{} in the right half-plane", margin.right, many);
}

std::string speedText(double speed) {
  return std::isnan(speed) ? std::string() : fmt::format(" at {}", shaftSpeedText(speed));
}

/// Damping within a shaft drives it where it turns fast.
const char* goodDamping(const state::StabilityMargin& margin) {
  return std::isnan(margin.speed) ? "add damping" : "add external damping";
}

/// What to do about a motion that grows.
std::string wayOut(const state::StabilityMargin& margin) {
  const bool below = std::isfinite(margin.threshold_below);
  const bool above = std::isfinite(margin.threshold_above);
  if (below && above) {
    return fmt::format("run below {} or above {}", shaftSpeedText(margin.threshold_below),
                       shaftSpeedText(margin.threshold_above));
  }
  if (below || above) {
    return fmt::format("run {} {}", below ? "below" : "above",
                       shaftSpeedText(below ? margin.threshold_below : margin.threshold_above));
  }
  return fmt::format("{}, or remove the destabilizing force", goodDamping(margin));
}

/// What to do about one that hardly decays.
std::string wayToStay(const state::StabilityMargin& margin) {
  if (std::isfinite(margin.threshold_above)) {
    return fmt::format("keep away from {}, or {}", shaftSpeedText(margin.threshold_above),
                       goodDamping(margin));
  }
  if (!margin.nearest_parameter.empty() && std::isnan(margin.nearest_change)) {  // it is 0
    return fmt::format("{}; unstable if {} reaches {:.4g}", goodDamping(margin),
                       margin.nearest_parameter, margin.nearest_value);
  }
  if (!margin.nearest_parameter.empty()) {
    return fmt::format("{}; unstable if {} {} by {:.2g} %", goodDamping(margin),
                       margin.nearest_parameter, margin.nearest_change < 0.0 ? "falls" : "rises",
                       100.0 * std::fabs(margin.nearest_change));
  }
  return goodDamping(margin);
}

std::string unstableText(const std::string& system, const state::StabilityMargin& margin,
                         AlarmCondition condition) {
  const std::string where = system + speedText(margin.speed) + aboutText(margin);
  switch (condition) {
    case AlarmCondition::kDanger:
      return fmt::format("{}: unstable, {}, growth rate {:.3g} 1/s: {}", where, growingText(margin),
                         -margin.decay_rate, wayOut(margin));
    case AlarmCondition::kWarning:
      if (margin.reduction_disagrees) {
        return fmt::format(
            "{}: verdict uncertain, decay rate {:.3g} 1/s of the full-order model, {:.3g} 1/s of "
            "the reduced-order model: retain more modes",
            where, margin.unreduced_decay_rate, margin.decay_rate);
      }
      return fmt::format("{}: repeated imaginary roots, the motion may grow with time: {}", where,
                         wayOut(margin));
    default:
      return fmt::format("{}: verdict uncertain{}, the alert stays until stability is certain",
                         where, std::isnan(margin.decay_rate) ? ", no equilibrium was found" : "");
  }
}

}  // namespace

StabilityAlarm::StabilityAlarm(std::string system, const AlarmSettings& settings)
    : system_(std::move(system)),
      settings_(settings),
      unstable_alarm_(settings.delaysOf(alert_type::kUnstable)),
      low_damping_alarm_(settings.delaysOf(alert_type::kLowDamping)),
      disagreement_alarm_(settings.delaysOf(alert_type::kRouthDisagrees)),
      spread_alarm_(settings.delaysOf(alert_type::kUnstableWithinSpread)) {}

void StabilityAlarm::set(const AlarmSettings& settings) {
  settings_ = settings;
  unstable_alarm_.setDelays(settings.delaysOf(alert_type::kUnstable));
  low_damping_alarm_.setDelays(settings.delaysOf(alert_type::kLowDamping));
  disagreement_alarm_.setDelays(settings.delaysOf(alert_type::kRouthDisagrees));
  spread_alarm_.setDelays(settings.delaysOf(alert_type::kUnstableWithinSpread));
}

void StabilityAlarm::update(const state::StabilityMargin& margin, AlertList& alerts) {
  updateUnstable(margin, alerts);
  updateLowDamping(margin, alerts);
  updateDisagreement(margin, alerts);
  updateSpread(margin, alerts);
}

void StabilityAlarm::updateUnstable(const state::StabilityMargin& margin, AlertList& alerts) {
  const AlarmCondition condition = verdictCondition(margin);
  const auto change = unstable_alarm_.update(margin.at.time, condition);
  if (change == ConditionAlarm::Change::kCleared) {
    alerts.clear(system_, alert_type::kUnstable, margin.at.time,
                 fmt::format("{}{}: stable again, decay rate {:.3g} 1/s", system_,
                             speedText(margin.speed), margin.decay_rate));
  } else if (unstable_alarm_.active() && condition != AlarmCondition::kClear) {
    state::Alert alert = alertAbout(margin);
    alert.type = alert_type::kUnstable;
    alert.severity = unstable_alarm_.severity();
    alert.text = unstableText(system_, margin, condition);
    alerts.raise(std::move(alert), margin.verdict_name);
  }
}

void StabilityAlarm::updateLowDamping(const state::StabilityMargin& margin, AlertList& alerts) {
  const AlarmCondition condition = dampingCondition(margin);
  const auto change = low_damping_alarm_.update(margin.at.time, condition);
  if (change == ConditionAlarm::Change::kCleared) {
    alerts.clear(system_, alert_type::kLowDamping, margin.at.time,
                 fmt::format("{}{}: damping sufficient again, log decrement {:.3g}, decay rate "
                             "{:.3g} 1/s",
                             system_, speedText(margin.speed), judgedLogDecrement(margin),
                             judgedDecayRate(margin)));
  } else if (low_damping_alarm_.active() && isRaising(condition)) {
    state::Alert alert = alertAbout(margin);
    alert.type = alert_type::kLowDamping;
    alert.severity = low_damping_alarm_.severity();
    if (judgedLogDecrement(margin) < settings_.log_decrement_warning) {
      alert.text =
          fmt::format("{}{}{}: log decrement {:.3g}, below {:g}: {}", system_,
                      speedText(margin.speed), aboutText(margin), judgedLogDecrement(margin),
                      settings_.log_decrement_warning, wayToStay(margin));
    } else {
      alert.text = fmt::format("{}{}{}: decay rate {:.3g} 1/s, below {:g} 1/s: {}", system_,
                               speedText(margin.speed), aboutText(margin), judgedDecayRate(margin),
                               settings_.decay_rate_alarm, wayToStay(margin));
    }
    alerts.raise(std::move(alert), "low damping");
  }
}

void StabilityAlarm::updateDisagreement(const state::StabilityMargin& margin, AlertList& alerts) {
  const bool judged = std::isfinite(margin.decay_rate);  // else the numbers were beyond a double
  const AlarmCondition condition = margin.routh_disagrees ? AlarmCondition::kWarning
                                   : judged               ? AlarmCondition::kClear
                                                          : AlarmCondition::kHold;
  const auto change = disagreement_alarm_.update(margin.at.time, condition);
  if (change == ConditionAlarm::Change::kCleared) {
    alerts.clear(system_, alert_type::kRouthDisagrees, margin.at.time,
                 fmt::format("{}{}: Routh's test and the eigenvalues agree again", system_,
                             speedText(margin.speed)));
  } else if (disagreement_alarm_.active() && margin.routh_disagrees) {
    state::Alert alert = alertAbout(margin);
    alert.type = alert_type::kRouthDisagrees;
    alert.severity = disagreement_alarm_.severity();
    alert.text = fmt::format(
        "{}{}: Routh's test counts {} roots in the right half-plane, the eigenvalues {}: the "
        "verdict is unreliable",
        system_, speedText(margin.speed), margin.right, margin.right_by_eigenvalues);
    alerts.raise(std::move(alert), "disagreement");
  }
}

void StabilityAlarm::updateSpread(const state::StabilityMargin& margin, AlertList& alerts) {
  const double part = margin.members == 0 ? 0.0
                                          : static_cast<double>(margin.members_beyond) /
                                                static_cast<double>(margin.members);
  const bool slow = margin.lowest_decay_rate < settings_.lowest_decay_rate;
  const AlarmCondition condition = margin.members == 0 ? AlarmCondition::kHold
                                   : slow || part > settings_.members_beyond
                                       ? AlarmCondition::kWarning
                                       : AlarmCondition::kClear;
  const auto change = spread_alarm_.update(margin.at.time, condition);
  if (change == ConditionAlarm::Change::kCleared) {
    alerts.clear(
        system_, alert_type::kUnstableWithinSpread, margin.at.time,
        fmt::format("{}{}: stable within the tolerances again, lowest decay rate {:.3g} 1/s",
                    system_, speedText(margin.speed), margin.lowest_decay_rate));
  } else if (spread_alarm_.active() && isRaising(condition)) {
    state::Alert alert = alertAbout(margin);
    alert.type = alert_type::kUnstableWithinSpread;
    alert.severity = spread_alarm_.severity();
    alert.text = fmt::format(
        "{}{}: {} of {} parameter samples have a decay rate below {:g} 1/s, the lowest found is "
        "{:.3g} 1/s: reduce the uncertainty or increase the margin",
        system_, speedText(margin.speed), margin.members_beyond, margin.members,
        settings_.decay_rate_alarm, margin.lowest_decay_rate);
    alerts.raise(std::move(alert), "within its spread");
  }
}

AlarmCondition StabilityAlarm::dampingCondition(const state::StabilityMargin& margin) const {
  // Once unstable, UNSTABLE speaks; and a margin that is not a number says nothing.
  if (verdictCondition(margin) != AlarmCondition::kClear || !requiresDamping(margin) ||
      !std::isfinite(judgedDecayRate(margin))) {
    return AlarmCondition::kHold;
  }
  // An overdamped system has no log decrement; one that is only marginal should have.
  if (std::isnan(judgedLogDecrement(margin)) &&
      static_cast<Verdict>(margin.verdict) != Verdict::kAsymptoticallyStable) {
    return AlarmCondition::kHold;
  }
  // A limit of zero is switched off; a NaN log decrement, overdamped, is below none.
  const auto below = [](double value, double limit) { return limit > 0.0 && value < limit; };
  if (below(judgedLogDecrement(margin), settings_.log_decrement_warning) ||
      below(judgedDecayRate(margin), settings_.decay_rate_alarm)) {
    return AlarmCondition::kWarning;
  }
  const double beyond = 1.0 + settings_.hysteresis;
  if (below(judgedLogDecrement(margin), beyond * settings_.log_decrement_warning) ||
      below(judgedDecayRate(margin), beyond * settings_.decay_rate_alarm)) {
    return AlarmCondition::kHold;
  }
  return AlarmCondition::kClear;
}

state::Alert StabilityAlarm::alertAbout(const state::StabilityMargin& margin) const {
  state::Alert alert;
  alert.system = system_;
  alert.time = margin.at.time;
  alert.speed = margin.speed;
  alert.decay_rate = margin.decay_rate;
  return alert;
}

}  // namespace whirl_twin

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

void setNumbers(const state::StabilityMargin& margin, state::Alert& alert) {
  alert.speed = margin.speed;
  alert.decay_rate = margin.decay_rate;
}

std::string unstableText(const state::StabilityMargin& margin, AlarmCondition condition) {
  const std::string where = speedText(margin.speed) + aboutText(margin);
  switch (condition) {
    case AlarmCondition::kDanger:
      return fmt::format("{}: unstable, {}, growth rate {:.3g} 1/s: {}", where, growingText(margin),
                         -margin.decay_rate, wayOut(margin));
    case AlarmCondition::kWarning:
      if (margin.reduction_disagrees) {
        return fmt::format(
            "{}: stability uncertain, the models disagree: decay rate {:.3g} 1/s of the full-order "
            "model, {:.3g} 1/s of the reduced-order model: retain more modes",
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

StabilityAlarm::StabilityAlarm(const std::string& system, const SharedSettings& settings,
                               bool damped)
    : settings_(settings),
      damped_(damped),
      unstable_(system, alert_type::kUnstable, settings, system),
      low_damping_(system, alert_type::kLowDamping, settings, system),
      disagreement_(system, alert_type::kRouthDisagrees, settings, system),
      spread_(system, alert_type::kUnstableWithinSpread, settings, system) {}

void StabilityAlarm::hold() {
  for (Alarm* alarm : {&unstable_, &low_damping_, &disagreement_, &spread_}) {
    alarm->hold();
  }
}

void StabilityAlarm::update(const state::StabilityMargin& margin, AlertList& alerts) {
  updateUnstable(margin, alerts);
  updateLowDamping(margin, alerts);
  updateDisagreement(margin, alerts);
  updateSpread(margin, alerts);
}

void StabilityAlarm::updateUnstable(const state::StabilityMargin& margin, AlertList& alerts) {
  const AlarmCondition condition = verdictCondition(margin);
  const auto describe = [&](state::Alert& alert) {
    setNumbers(margin, alert);
    alert.text = unstableText(margin, condition);
    return margin.verdict_name;
  };
  unstable_.update(margin.at.time, condition, alerts, describe, [&] {
    return fmt::format("{}: stable again, decay rate {:.3g} 1/s", speedText(margin.speed),
                       margin.decay_rate);
  });
  if (condition == AlarmCondition::kHold && unstable_.active()) {  // its text: uncertain
    unstable_.raise(margin.at.time, alerts, describe);
  }
}

void StabilityAlarm::updateLowDamping(const state::StabilityMargin& margin, AlertList& alerts) {
  const double decrement = dampingLogDecrement(margin);
  const double rate = dampingDecayRate(margin);
  low_damping_.update(
      margin.at.time, dampingCondition(margin), alerts,
      [&](state::Alert& alert) {
        setNumbers(margin, alert);
        const std::string low =
            decrement < leastLogDecrement()
                ? fmt::format("log decrement {:.3g}, below {:g}", decrement, leastLogDecrement())
                : fmt::format("decay rate {:.3g} 1/s, below {:g} 1/s", rate, slowestDecay());
        alert.text = fmt::format("{}{}: {}: {}", speedText(margin.speed), aboutText(margin), low,
                                 wayToStay(margin));
        return "low damping";
      },
      [&] {
        return fmt::format(
            "{}: damping sufficient again, log decrement {:.3g}, decay rate {:.3g} 1/s",
            speedText(margin.speed), decrement, rate);
      });
}

void StabilityAlarm::updateDisagreement(const state::StabilityMargin& margin, AlertList& alerts) {
  const bool evaluated = std::isfinite(margin.decay_rate);  // else numbers were beyond a double
  const AlarmCondition condition = margin.routh_disagrees ? AlarmCondition::kWarning
                                   : evaluated            ? AlarmCondition::kClear
                                                          : AlarmCondition::kHold;
  disagreement_.update(
      margin.at.time, condition, alerts,
      [&](state::Alert& alert) {
        setNumbers(margin, alert);
        alert.text = fmt::format(
            "{}: Routh's test counts {} roots in the right half-plane, the eigenvalues {}: the "
            "verdict is unreliable",
            speedText(margin.speed), margin.right, margin.right_by_eigenvalues);
        return "disagreement";
      },
      [&] {
        return fmt::format("{}: Routh's test and the eigenvalues agree again",
                           speedText(margin.speed));
      });
}

void StabilityAlarm::updateSpread(const state::StabilityMargin& margin, AlertList& alerts) {
  const double part = margin.members == 0 ? 0.0
                                          : static_cast<double>(margin.members_beyond) /
                                                static_cast<double>(margin.members);
  const bool slow = margin.lowest_decay_rate < settings_->lowest_decay_rate;
  const AlarmCondition condition = margin.members == 0
                                       ? AlarmCondition::kHold
                                       : warningIf(slow || part > settings_->members_beyond);
  spread_.update(
      margin.at.time, condition, alerts,
      [&](state::Alert& alert) {
        setNumbers(margin, alert);
        alert.text = fmt::format(
            "{}: {} of {} parameter samples have a decay rate below {:g} 1/s, the lowest found "
            "is {:.3g} 1/s: reduce the uncertainty or increase the margin",
            speedText(margin.speed), margin.members_beyond, margin.members, slowestDecay(),
            margin.lowest_decay_rate);
        return "within its spread";
      },
      [&] {
        return fmt::format("{}: stable within the tolerances again, lowest decay rate {:.3g} 1/s",
                           speedText(margin.speed), margin.lowest_decay_rate);
      });
}

AlarmCondition StabilityAlarm::dampingCondition(const state::StabilityMargin& margin) const {
  // Once unstable, UNSTABLE is reported; and a margin that is not a number is unknown.
  if (verdictCondition(margin) != AlarmCondition::kClear || !requiresDamping(margin) ||
      !std::isfinite(dampingDecayRate(margin))) {
    return AlarmCondition::kHold;
  }
  // An overdamped system has no log decrement; one that is only marginal should have.
  if (std::isnan(dampingLogDecrement(margin)) &&
      static_cast<Verdict>(margin.verdict) != Verdict::kAsymptoticallyStable) {
    return AlarmCondition::kHold;
  }
  // A limit of zero is switched off; a NaN log decrement, overdamped, is below none.
  const auto below = [](double value, double limit) { return limit > 0.0 && value < limit; };
  if (below(dampingLogDecrement(margin), leastLogDecrement()) ||
      below(dampingDecayRate(margin), slowestDecay())) {
    return AlarmCondition::kWarning;
  }
  const double beyond = 1.0 + settings_->hysteresis;
  if (below(dampingLogDecrement(margin), beyond * leastLogDecrement()) ||
      below(dampingDecayRate(margin), beyond * slowestDecay())) {
    return AlarmCondition::kHold;
  }
  return AlarmCondition::kClear;
}

}  // namespace whirl_twin

#include "monitoring/model_alarms.h"

#include <fmt/format.h>

#include <cmath>
#include <optional>
#include <utility>

#include "analysis/routh.h"
#include "control/shaft_angle.h"
#include "messages/alert.h"
#include "messages/names.h"

namespace whirl_twin {
namespace {

/// Standard deviations of the measured rate: once in some ten thousand records by chance, with the
/// few parts that its deviation is estimated from.
constexpr double kDifferentDecayDeviations = 6.0;
constexpr double kSameDecayDeviations = 4.0;
/// Of the larger of the two rates, a difference that does not matter.
constexpr double kNegligibleDecay = 0.25;
constexpr double kMaxAngle = 1.0e15;     // rad, beyond which a double holds no phase
constexpr std::size_t kMaxFaults = 800;  // bytes, of the 1000 that a message has

/// Of the way from the value of a right model to its limit: some two and a half standard
/// deviations.
constexpr double kClearPart = 0.5;

/// Of a statistic that is `at` where the model is right.
AlarmCondition statisticCondition(double value, double at, double least, double most) {
  if (std::isnan(value) || std::isnan(least) || std::isnan(most)) {
    return AlarmCondition::kHold;
  }
  if (value > most || value < least) {
    return AlarmCondition::kWarning;
  }
  const bool near = value < at + kClearPart * (most - at) && value > at - kClearPart * (at - least);
  return near ? AlarmCondition::kClear : AlarmCondition::kHold;
}

const char* channelStatusText(state::ChannelStatus status) {
  switch (status) {
    case state::ChannelStatus::kSilent:
      return "has no new samples";
    case state::ChannelStatus::kRefused:
      return "is rejected: too far from its prediction";
    case state::ChannelStatus::kInvalid:
      return "is invalid or not finite";
    default:
      return "";
  }
}

}  // namespace

void DecayAlarm::hold() {
  audit_.clear();
  alarm_.hold();
}

void DecayAlarm::update(const state::StabilityMargin& margin) {
  const bool stable = margin.verdict == static_cast<std::uint8_t>(Verdict::kAsymptoticallyStable);
  model_ = stable ? margin.decay_rate : kNaN;
}

void DecayAlarm::update(const state::WhirlState& whirl, AlertList& alerts) {
  if (alarm_.settings().decay_audit != record_) {
    record_ = alarm_.settings().decay_audit;
    audit_ = DecayAudit(record_);
  }
  if (record_ <= 0.0) {
    if (alarm_.active()) {
      alarm_.state().clearNow();
      alerts.clear(alarm_.subject(), alarm_.type(), whirl.at.time,
                   fmt::format("{}: its decay rate is no longer measured", alarm_.subject()));
    }
    return;
  }
  if (!(std::fabs(whirl.shaft_angle) <= kMaxAngle)) {
    audit_.clear();
    return;
  }
  const std::int64_t passed = whirl.at.step - last_;
  index_ += passed == stride_ ? 1 : 2;  // a different distance is a hole
  stride_ = passed;
  last_ = whirl.at.step;
  const ShaftAngle angle = shaftAngle(whirl.shaft_angle);
  const std::optional<AuditedDecay> measured = audit_.take(
      {index_, whirl.at.time, angle.turns, angle.remainder, whirl.speed, whirl.x, whirl.y});
  if (measured && std::isfinite(model_)) {
    evaluate(*measured, whirl.speed, alerts);
  }
}

void DecayAlarm::evaluate(const AuditedDecay& measured, double speed, AlertList& alerts) {
  const double apart = std::fabs(measured.decay_rate - model_);
  const double negligible =
      kNegligibleDecay * std::fmax(std::fabs(measured.decay_rate), std::fabs(model_));
  AlarmCondition condition = AlarmCondition::kHold;
  if (apart > kDifferentDecayDeviations * measured.deviation && apart > negligible) {
    condition = AlarmCondition::kWarning;
  } else if (apart < kSameDecayDeviations * measured.deviation || apart < negligible) {
    condition = AlarmCondition::kClear;
  }
  const std::string rates = fmt::format(
      "at {} the mode at {:.1f} rad/s has a decay rate of {:.3g} +- {:.2g} 1/s, in the model "
      "{:.3g} 1/s",
      shaftSpeedText(speed), std::fabs(measured.frequency), measured.decay_rate, measured.deviation,
      model_);
  alarm_.update(
      measured.time, condition, alerts,
      [&](state::Alert& alert) {
        const bool less = measured.decay_rate < model_;
        alert.speed = speed;
        alert.decay_rate = measured.decay_rate;
        alert.text =
            fmt::format("{}: the margins of the model do not apply to the machine; {}", rates,
                        less ? "it is closer to instability" : "find out what changed");
        return less ? "less" : "more";
      },
      [&] { return rates; });
}

void EstimatorAlarm::update(const state::FollowState& follow, bool mismatch_raised,
                            AlertList& alerts) {
  updateSensors(follow, alerts);
  updateDrift(follow, alerts);
  updateMismatch(follow, mismatch_raised, alerts);
}

void EstimatorAlarm::updateMismatch(const state::FollowState& follow, bool raised_by_other,
                                    AlertList& alerts) {
  const AlarmCondition size =
      statisticCondition(follow.mismatch, 1.0, follow.mismatch_least, follow.mismatch_limit);
  const AlarmCondition lasting =
      statisticCondition(follow.whiteness, 0.0, -follow.whiteness_limit, follow.whiteness_limit);
  const AlarmCondition condition = isRaising(size) || isRaising(lasting) ? AlarmCondition::kWarning
                                   : size == lasting                     ? size
                                                                         : AlarmCondition::kHold;
  if (raised_by_other) {
    mismatch_.step(follow.at.time, condition);
    return;
  }
  const std::string squares =
      fmt::format("normalized innovation squared (NIS) {:.3g}, expected 1", follow.mismatch);
  mismatch_.update(
      follow.at.time, condition, alerts,
      [&](state::Alert& alert) {
        const bool more = follow.mismatch > follow.mismatch_limit;
        if (!isRaising(size)) {
          alert.text = fmt::format(
              "autocorrelation of the innovations {:.2g}, limit {:.2g}: the model has a "
              "persistent error; check DRIFT, then fit the model again",
              follow.whiteness, follow.whiteness_limit);
          return "lasting";
        }
        alert.text = fmt::format(
            "{}, {} the limit {:.3g}: {}", squares, more ? "above" : "below",
            more ? follow.mismatch_limit : follow.mismatch_least,
            more ? "the model lacks something that moves the machine; check SENSOR and DRIFT, then "
                   "fit the model again"
                 : "the noise is lower than specified; check for a stuck signal, else reduce the "
                   "standard deviations");
        return more ? "more" : "less";
      },
      [&] { return fmt::format("{}, innovations white", squares); });
}

void EstimatorAlarm::updateDrift(const state::FollowState& follow, AlertList& alerts) {
  // Before a reference is learned there is no limit, and nothing is known.
  const AlarmCondition condition = !follow.drift_parameter.empty()  ? AlarmCondition::kWarning
                                   : std::isnan(follow.drift_limit) ? AlarmCondition::kHold
                                                                    : AlarmCondition::kClear;
  drift_.update(
      follow.at.time, condition, alerts,
      [&](state::Alert& alert) {
        std::string unit;
        for (std::size_t i = 0; i < follow.parameter.size(); ++i) {
          if (follow.parameter[i] == follow.drift_parameter && !follow.parameter_unit[i].empty()) {
            unit = " " + printable(follow.parameter_unit[i]);
          }
        }
        const double from = follow.drift_from;
        const double to = follow.drift_to;
        const std::string part =
            from != 0.0 ? fmt::format(" ({:+.2g} %)", 100.0 * (to - from) / std::fabs(from)) : "";
        alert.text = fmt::format(
            "{} changed from {:.4g} to {:.4g}{}{} since {:.1f} s: inspect the machine, and use "
            "the estimated value for its margins",
            follow.drift_parameter, from, to, unit, part, follow.drift_since);
        return follow.drift_parameter + (to > from ? " up" : " down");
      },
      [&] { return "its parameters are back at their reference"; });
}

std::map<std::string, std::string> EstimatorAlarm::faults(const state::FollowState& follow) const {
  const AlarmSettings& settings = sensor_.settings();
  std::map<std::string, std::string> faults;
  for (std::size_t i = 0; i < follow.channel.size(); ++i) {
    const auto status = static_cast<state::ChannelStatus>(follow.channel_status[i]);
    if (status != state::ChannelStatus::kUsed) {
      faults[follow.channel[i]] = channelStatusText(status);
    }
  }
  if (has_shaft_ && !follow.shaft_known) {
    faults["the shaft's angle"] = "is unknown; check the keyphasor";
  }
  if (settings.clock_offset > 0.0 && std::fabs(follow.clock_offset) > settings.clock_offset) {
    faults["the machine's clock"] = fmt::format("has an offset of {:+.3g} s, limit {:g} s",
                                                follow.clock_offset, settings.clock_offset);
  } else if (settings.clock_drift > 0.0 && std::fabs(follow.clock_drift) > settings.clock_drift) {
    faults["the machine's clock"] =
        fmt::format("drifts by {:+.3g} s/s, limit {:g}", follow.clock_drift, settings.clock_drift);
  }
  return faults;
}

void EstimatorAlarm::updateSensors(const state::FollowState& follow, AlertList& alerts) {
  const double time = follow.at.time;
  const std::map<std::string, std::string> present = faults(follow);
  std::map<std::string, double> since;
  std::string text, which;
  for (const auto& [what, how] : present) {
    const auto before = fault_since_.find(what);
    const double began =
        before == fault_since_.end() || before->second > time ? time : before->second;
    since[what] = began;
    if (time - began >= sensor_.settings().sensor_delay) {
      text += (text.empty() ? "" : "; ") + what + " " + how;
      which += what + " ";
    }
  }
  fault_since_ = std::move(since);
  const AlarmCondition condition = !text.empty()     ? AlarmCondition::kWarning
                                   : present.empty() ? AlarmCondition::kClear
                                                     : AlarmCondition::kHold;
  sensor_.update(
      time, condition, alerts,
      [&](state::Alert& alert) {
        const bool whole = text.size() <= kMaxFaults;
        alert.text = fmt::format("{}{}: the estimate is less certain",
                                 whole ? text : text.substr(0, text.rfind(';', kMaxFaults)),
                                 whole ? "" : " ...");
        return which;
      },
      [&] { return "its sensors are used again"; });
}

}  // namespace whirl_twin

#include "monitoring/following_alarm.h"

#include <fmt/format.h>

#include <cmath>
#include <utility>

#include "messages/alert.h"
#include "messages/names.h"

namespace whirl_twin {
namespace {

/// Of the way from what a right model gives to its limit: some two and a half standard deviations.
constexpr double kClearPart = 0.5;

/// Of a statistic that is `at` where the model is right.
AlarmCondition statisticCondition(double value, double at, double least, double most) {
  if (std::isnan(value) || std::isnan(least) || std::isnan(most)) {
    return AlarmCondition::kHold;
  }
  if (value > most || value < least) {
    return AlarmCondition::kWarning;
  }
  const bool together =
      value < at + kClearPart * (most - at) && value > at - kClearPart * (at - least);
  return together ? AlarmCondition::kClear : AlarmCondition::kHold;
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

FollowingAlarm::FollowingAlarm(std::string system, bool has_shaft, const AlarmSettings& settings)
    : system_(std::move(system)),
      has_shaft_(has_shaft),
      mismatch_alarm_(settings.delaysOf(alert_type::kModelMismatch)),
      drift_alarm_(settings.delaysOf(alert_type::kDrift)),
      sensor_alarm_(settings.delaysOf(alert_type::kSensor)) {
  set(settings);
}

void FollowingAlarm::set(const AlarmSettings& settings) {
  sensor_delay_ = settings.sensor_delay;
  clock_offset_ = settings.clock_offset;
  clock_drift_ = settings.clock_drift;
  mismatch_alarm_.setDelays(settings.delaysOf(alert_type::kModelMismatch));
  drift_alarm_.setDelays(settings.delaysOf(alert_type::kDrift));
  sensor_alarm_.setDelays(settings.delaysOf(alert_type::kSensor));
}

void FollowingAlarm::update(const state::FollowState& follow, bool mismatch_told,
                            AlertList& alerts) {
  updateSensors(follow, alerts);
  updateDrift(follow, alerts);
  updateMismatch(follow, mismatch_told, alerts);
}

state::Alert FollowingAlarm::alertOf(const char* type, double time,
                                     const ConditionAlarm& alarm) const {
  state::Alert alert;
  alert.system = system_;
  alert.type = type;
  alert.severity = alarm.severity();
  alert.time = time;
  return alert;
}

void FollowingAlarm::updateMismatch(const state::FollowState& follow, bool told,
                                    AlertList& alerts) {
  const double time = follow.at.time;
  const AlarmCondition size =
      statisticCondition(follow.mismatch, 1.0, follow.mismatch_least, follow.mismatch_limit);
  const AlarmCondition lasting =
      statisticCondition(follow.whiteness, 0.0, -follow.whiteness_limit, follow.whiteness_limit);
  const AlarmCondition condition = isRaising(size) || isRaising(lasting) ? AlarmCondition::kWarning
                                   : size == lasting                     ? size
                                                                         : AlarmCondition::kHold;
  const std::string squares =
      fmt::format("normalized innovation squared (NIS) {:.3g}, expected 1", follow.mismatch);
  if (mismatch_alarm_.update(time, condition) == ConditionAlarm::Change::kCleared) {
    if (!told) {
      alerts.clear(system_, alert_type::kModelMismatch, time,
                   fmt::format("{}: {}, innovations white", system_, squares));
    }
  } else if (mismatch_alarm_.active() && isRaising(condition) && !told) {
    state::Alert alert = alertOf(alert_type::kModelMismatch, time, mismatch_alarm_);
    const bool more = follow.mismatch > follow.mismatch_limit;
    if (isRaising(size)) {
      alert.text =
          fmt::format("{}: {}, {} the limit {:.3g}: {}", system_, squares, more ? "above" : "below",
                      more ? follow.mismatch_limit : follow.mismatch_least,
                      more ? "the model lacks something that moves the machine; check SENSOR and "
                             "DRIFT, then fit the model again"
                           : "the noise is lower than specified; check for a stuck signal, else "
                             "reduce the standard deviations");
    } else {
      alert.text = fmt::format(
          "{}: autocorrelation of the innovations {:.2g}, limit {:.2g}: the model has a persistent "
          "error; check DRIFT, then fit the model again",
          system_, follow.whiteness, follow.whiteness_limit);
    }
    alerts.raise(std::move(alert), !isRaising(size) ? "lasting" : more ? "more" : "less");
  }
}

void FollowingAlarm::updateDrift(const state::FollowState& follow, AlertList& alerts) {
  const double time = follow.at.time;
  const bool drifting = !follow.drift_parameter.empty();
  // Before a reference is learned there is no limit, and nothing can be said.
  const AlarmCondition condition = drifting                         ? AlarmCondition::kWarning
                                   : std::isnan(follow.drift_limit) ? AlarmCondition::kHold
                                                                    : AlarmCondition::kClear;
  if (drift_alarm_.update(time, condition) == ConditionAlarm::Change::kCleared) {
    alerts.clear(system_, alert_type::kDrift, time,
                 fmt::format("{}: its parameters are back at their reference", system_));
  } else if (drift_alarm_.active() && drifting) {
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
    state::Alert alert = alertOf(alert_type::kDrift, time, drift_alarm_);
    alert.text = fmt::format(
        "{}: {} changed from {:.4g} to {:.4g}{}{} since {:.1f} s: inspect the machine, and use the "
        "estimated value for its margins",
        system_, follow.drift_parameter, from, to, unit, part, follow.drift_since);
    alerts.raise(std::move(alert), follow.drift_parameter + (to > from ? " up" : " down"));
  }
}

std::map<std::string, std::string> FollowingAlarm::wrong(const state::FollowState& follow) const {
  std::map<std::string, std::string> wrong;
  for (std::size_t i = 0; i < follow.channel.size(); ++i) {
    const auto status = static_cast<state::ChannelStatus>(follow.channel_status[i]);
    if (status != state::ChannelStatus::kUsed) {
      wrong[follow.channel[i]] = channelStatusText(status);
    }
  }
  if (has_shaft_ && !follow.shaft_known) {
    wrong["the shaft's angle"] = "is unknown; check the keyphasor";
  }
  if (clock_offset_ > 0.0 && std::fabs(follow.clock_offset) > clock_offset_) {
    wrong["the machine's clock"] =
        fmt::format("has an offset of {:+.3g} s, limit {:g} s", follow.clock_offset, clock_offset_);
  } else if (clock_drift_ > 0.0 && std::fabs(follow.clock_drift) > clock_drift_) {
    wrong["the machine's clock"] =
        fmt::format("drifts by {:+.3g} s/s, limit {:g}", follow.clock_drift, clock_drift_);
  }
  return wrong;
}

void FollowingAlarm::updateSensors(const state::FollowState& follow, AlertList& alerts) {
  const double time = follow.at.time;
  const std::map<std::string, std::string> wrong = this->wrong(follow);
  std::map<std::string, double> since;
  std::string text, which;
  for (const auto& [what, how] : wrong) {
    const auto before = wrong_since_.find(what);
    const double began =
        before == wrong_since_.end() || before->second > time ? time : before->second;
    since[what] = began;
    if (time - began >= sensor_delay_) {
      text += (text.empty() ? "" : "; ") + what + " " + how;
      which += what + " ";
    }
  }
  wrong_since_ = std::move(since);
  const AlarmCondition condition = !text.empty()   ? AlarmCondition::kWarning
                                   : wrong.empty() ? AlarmCondition::kClear
                                                   : AlarmCondition::kHold;
  if (sensor_alarm_.update(time, condition) == ConditionAlarm::Change::kCleared) {
    alerts.clear(system_, alert_type::kSensor, time,
                 fmt::format("{}: its sensors are used again", system_));
  } else if (sensor_alarm_.active() && isRaising(condition)) {
    state::Alert alert = alertOf(alert_type::kSensor, time, sensor_alarm_);
    constexpr std::size_t kLongest = 800;  // bytes, of the 1000 that a message has
    const bool whole = text.size() <= kLongest;
    alert.text =
        fmt::format("{}: {}{}: the estimate is less certain", system_,
                    whole ? text : text.substr(0, text.rfind(';', kLongest)), whole ? "" : " ...");
    alerts.raise(std::move(alert), which);
  }
}

}  // namespace whirl_twin

#include "monitoring/vibration_alarms.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <utility>

#include "messages/alert.h"

namespace whirl_twin {
namespace {

constexpr double kGainMeanOver = 0.5;  // s
constexpr double kMillimetre = 1.0e3;  // per metre

const char* amplitudeAdvice(bool danger) {
  return danger ? "stop the machine or change the speed" : "find the cause or change the speed";
}

}  // namespace

double StartUp::multiplier(double time, double speed, double acceleration) {
  if (time < gained_at_) {  // time was set back
    gained_at_ = -kInfinity;
  }
  const double passed = time - time_;
  const double now =
      speed == 0.0 ? std::abs(acceleration) : std::copysign(1.0, speed) * acceleration;
  if (!(passed >= 0.0) || !std::isfinite(mean_)) {  // the first, or time was set back
    mean_ = now;
  } else if (passed > 0.0) {
    const double gained = (std::abs(speed) - std::abs(speed_)) / passed;
    mean_ += (gained - mean_) * -std::expm1(-passed / kGainMeanOver);
  }
  time_ = time;
  speed_ = speed;
  if (now > settings_->start_up_acceleration && mean_ > settings_->start_up_acceleration) {
    begun_ = time - gained_at_ >= settings_->clear_delay ? time : begun_;
    gained_at_ = time;
  }
  return time - gained_at_ < settings_->clear_delay && time - begun_ < settings_->max_inhibition
             ? settings_->trip_multiply
             : 1.0;
}

void StartUpNotice::update(const state::DriveState& shaft, AlertList& alerts) {
  const double by = start_up_.multiplier(shaft.at.time, shaft.speed, shaft.acceleration);
  const bool has_levels = settings_->amplitude.count(system_) + settings_->zones.count(system_) +
                              settings_->voting.count(system_) >
                          0;
  const bool known = alerts.find(system_, alert_type::kTripMultiplied) != nullptr;
  if (by > 1.0 && has_levels && !known) {
    state::Alert alert;
    alert.type = alert_type::kTripMultiplied;
    alert.system = system_;
    alert.time = shaft.at.time;
    alert.stamp = shaft.at.stamp;
    alert.speed = shaft.speed;
    alert.acceleration = shaft.acceleration;
    alert.text = fmt::format(
        "{}: amplitude levels and zones are multiplied by {:g} during start-up, for at most {:g} s",
        system_, by, settings_->max_inhibition);
    alerts.raise(alert, alert.text);
  } else if (known && !(by > 1.0)) {
    alerts.clear(system_, alert_type::kTripMultiplied, shaft.at.time,
                 fmt::format("{}: amplitude levels and zones are no longer multiplied", system_));
  }
}

void AmplitudeAlarm::update(double time, double amplitude, double speed, double acceleration,
                            AlertList& alerts) {
  const AmplitudeLevels* const levels = settingOf(alarm_.settings().amplitude, alarm_.subject());
  if (levels == nullptr && !alarm_.active()) {  // without levels it can only clear
    return;
  }
  if (!std::isfinite(amplitude) || !std::isfinite(speed) || !std::isfinite(time)) {
    alarm_.step(time, AlarmCondition::kHold);
    return;
  }
  const double by = start_up_.multiplier(time, speed, acceleration);
  const double alert_level = levels == nullptr ? kInfinity : by * levels->alertAt(speed);
  const double danger_level = levels == nullptr ? kInfinity : by * levels->dangerAt(speed);
  const AlarmCondition condition = levelCondition(amplitude, std::fmin(alert_level, danger_level),
                                                  danger_level, alarm_.settings().hysteresis);
  alarm_.update(
      time, condition, alerts,
      [&](state::Alert& alert) {
        const bool danger = condition == AlarmCondition::kDanger;
        alert.speed = speed;
        alert.acceleration = acceleration;
        alert.amplitude = amplitude;
        alert.amplitude_limit = danger ? danger_level : alert_level;
        alert.text =
            fmt::format("vibration {:.3g} mm 0-peak at {}, above the {} level {:.3g} mm{}: {}",
                        kMillimetre * amplitude, shaftSpeedText(speed), danger ? "danger" : "alert",
                        kMillimetre * alert.amplitude_limit,
                        by != 1.0 ? fmt::format(" (multiplied by {:g} during start-up)", by) : "",
                        amplitudeAdvice(danger));
        return danger ? "danger" : "alert";
      },
      [&] {
        return fmt::format("vibration back to {:.3g} mm 0-peak at {}", kMillimetre * amplitude,
                           shaftSpeedText(speed));
      });
}

VotedAlarm::VotedAlarm(const std::string& system, const SharedSettings& settings)
    : start_up_(settings), alarm_(system, alert_type::kVotedAmplitude, settings) {
  update();
}

void VotedAlarm::update() {
  const AlarmSettings& settings = alarm_.settings();
  const Voting* const voting = settingOf(settings.voting, alarm_.subject());
  if (voting == nullptr) {
    if (alarm_.active()) {  // no number of votes keeps it, from now on
      voting_->agree = static_cast<int>(sources_.size()) + 1;
    } else {
      sources_.clear();
    }
    return;
  }
  voting_ = *voting;
  std::vector<Source> sources;
  for (const std::string& name : voting_->of) {
    const auto known = std::find_if(sources_.begin(), sources_.end(),
                                    [&](const Source& source) { return source.name == name; });
    sources.push_back(known != sources_.end()
                          ? *known
                          : Source{name, DataQuality(settings.data_timeout, voting_->range)});
    sources.back().quality.set(settings.data_timeout, voting_->range);
  }
  sources_ = std::move(sources);
}

bool VotedAlarm::listensTo(const std::string& source) const {
  return std::any_of(sources_.begin(), sources_.end(),
                     [&](const Source& known) { return known.name == source; });
}

VotedAlarm::Count VotedAlarm::count(double by) const {
  Count count;
  const double danger = by * voting_->danger;
  const double alert = std::min(by * voting_->alert, danger);
  for (const Source& source : sources_) {
    if (!source.votes) {
      ++count.doubtful;
    } else if (source.amplitude > alert) {
      ++count.warning;
      count.danger += source.amplitude > danger ? 1 : 0;
    } else if (source.amplitude > alert * (1.0 - alarm_.settings().hysteresis)) {
      ++count.doubtful;
    }
  }
  return count;
}

void VotedAlarm::update(const state::WhirlState& whirl, double acceleration, double wall_time,
                        AlertList& alerts) {
  for (Source& source : sources_) {
    if (source.name == whirl.system) {
      source.votes = source.quality.take(whirl, wall_time);
      if (source.votes) {
        source.amplitude = source.vibration.take(whirl);
        source.votes = std::isfinite(source.amplitude);
      }
    }
  }
  const bool removed = voting_->agree > static_cast<int>(sources_.size());
  const double by = start_up_.multiplier(whirl.at.time, whirl.speed, acceleration);
  const Count votes = count(by);
  const AlarmCondition condition = votes.danger >= voting_->agree    ? AlarmCondition::kDanger
                                   : votes.warning >= voting_->agree ? AlarmCondition::kWarning
                                   : votes.warning + votes.doubtful >= voting_->agree
                                       ? AlarmCondition::kHold
                                       : AlarmCondition::kClear;
  bool cleared = false;
  alarm_.update(
      whirl.at.time, condition, alerts,
      [&](state::Alert& alert) {
        describe(whirl, by, condition == AlarmCondition::kDanger, alert);
        return fmt::format("{} of them", votes.warning);
      },
      [&] {
        cleared = true;
        return removed ? "its voting was removed"
                       : fmt::format("fewer than {} of {} sources above the level", voting_->agree,
                                     sources_.size());
      });
  if (cleared && removed) {
    sources_.clear();
  }
}

void VotedAlarm::describe(const state::WhirlState& whirl, double by, bool danger,
                          state::Alert& alert) const {
  alert.speed = whirl.speed;
  alert.amplitude_limit =
      by * (danger ? voting_->danger : std::min(voting_->alert, voting_->danger));
  std::vector<double> above;
  std::string names;
  std::string silent;
  for (const Source& source : sources_) {
    if (!source.votes) {
      silent += (silent.empty() ? "; bad data: " : ", ") + source.name;
    } else if (source.amplitude > alert.amplitude_limit) {
      above.push_back(source.amplitude);
      names += fmt::format("{}{} {:.3g} mm 0-peak", names.empty() ? "" : ", ", source.name,
                           kMillimetre * source.amplitude);
    }
  }
  // What so many of them agree on.
  std::sort(above.begin(), above.end(), std::greater<>());
  alert.amplitude = above[static_cast<std::size_t>(voting_->agree) - 1];
  alert.text =
      fmt::format("{} of {} sources above the {} level {:.3g} mm{} ({}{}): {}", above.size(),
                  sources_.size(), danger ? "danger" : "alert", kMillimetre * alert.amplitude_limit,
                  by != 1.0 ? fmt::format(", multiplied by {:g} during start-up", by) : "", names,
                  silent, amplitudeAdvice(danger));
}

void VotedAlarm::tick(double wall_time) {
  for (Source& source : sources_) {
    if (source.votes && source.quality.isStale(wall_time)) {
      source.votes = false;
      alarm_.hold();
    }
  }
}

std::string VotedAlarm::problem(double wall_time, bool paused) const {
  std::string all;
  for (const Source& source : sources_) {
    const std::string why = source.quality.problem(wall_time, paused);
    if (!why.empty()) {
      all += fmt::format("{}{} {}", all.empty() ? "not voting: " : "; ", source.name, why);
    }
  }
  return all;
}

}  // namespace whirl_twin

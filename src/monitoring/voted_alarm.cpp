#include "monitoring/voted_alarm.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <utility>

#include "messages/alert.h"

namespace whirl_twin {

namespace {

constexpr double kMillimetre = 1.0e3;  // per metre

}  // namespace

struct VotedAlarm::Count {
  int danger = 0;
  int warning = 0;  ///< danger included
  int doubtful = 0;
};

VotedAlarm::VotedAlarm(std::string system, const AlarmSettings& settings)
    : system_(std::move(system)),
      start_up_(settings),
      alarm_(settings.delaysOf(alert_type::kVotedAmplitude)) {
  set(settings);
}

void VotedAlarm::set(const AlarmSettings& settings) {
  hysteresis_ = settings.hysteresis;
  start_up_.set(settings);
  alarm_.setDelays(settings.delaysOf(alert_type::kVotedAmplitude));
  const auto voting = settings.voting.find(system_);
  if (voting == settings.voting.end()) {
    if (alarm_.active()) {  // no number of votes keeps it, from now on
      voting_->agree = static_cast<int>(sources_.size()) + 1;
    } else {
      sources_.clear();
    }
    return;
  }
  voting_ = voting->second;
  std::vector<Source> sources;
  for (const std::string& name : voting_->of) {
    const auto known = std::find_if(sources_.begin(), sources_.end(),
                                    [&](const Source& source) { return source.name == name; });
    Source source = known != sources_.end()
                        ? *known
                        : Source{name, DataQuality(settings.data_timeout, voting_->range)};
    source.quality.set(settings.data_timeout, voting_->range);
    sources.push_back(std::move(source));
  }
  sources_ = std::move(sources);
}

bool VotedAlarm::listensTo(const std::string& source) const {
  return std::any_of(sources_.begin(), sources_.end(),
                     [&](const Source& known) { return known.name == source; });
}

VotedAlarm::Count VotedAlarm::count(double by) const {
  Count count;
  const double alert = by * voting_->alert;
  const double danger = by * voting_->danger;
  for (const Source& source : sources_) {
    if (!source.votes) {
      ++count.doubtful;
    } else if (source.amplitude > std::min(alert, danger)) {
      ++count.warning;
      count.danger += source.amplitude > danger ? 1 : 0;
    } else if (source.amplitude > std::min(alert, danger) * (1.0 - hysteresis_)) {
      ++count.doubtful;
    }
  }
  return count;
}

void VotedAlarm::take(const state::WhirlState& whirl, double acceleration, double wall_time,
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
  const bool taken_away = voting_->agree > static_cast<int>(sources_.size());
  const double time = whirl.at.time;
  const double by = start_up_.multiplier(time, whirl.speed, acceleration);
  const Count votes = count(by);
  const AlarmCondition condition = votes.danger >= voting_->agree    ? AlarmCondition::kDanger
                                   : votes.warning >= voting_->agree ? AlarmCondition::kWarning
                                   : votes.warning + votes.doubtful >= voting_->agree
                                       ? AlarmCondition::kHold
                                       : AlarmCondition::kClear;
  if (alarm_.update(time, condition) == ConditionAlarm::Change::kCleared) {
    alerts.clear(system_, alert_type::kVotedAmplitude, time,
                 taken_away ? fmt::format("{}: its voting was removed", system_)
                            : fmt::format("{}: fewer than {} of {} sources above the level",
                                          system_, voting_->agree, sources_.size()));
    if (taken_away) {
      sources_.clear();
    }
  } else if (alarm_.active() && isRaising(condition)) {
    alerts.raise(alertOf(whirl, by, votes), fmt::format("{} of them", votes.warning));
  }
}

state::Alert VotedAlarm::alertOf(const state::WhirlState& whirl, double by,
                                 const Count& count) const {
  const bool danger = count.danger >= voting_->agree;
  state::Alert alert;
  alert.system = system_;
  alert.type = alert_type::kVotedAmplitude;
  alert.severity = alarm_.severity();
  alert.time = whirl.at.time;
  alert.speed = whirl.speed;
  alert.amplitude_limit =
      by * (danger ? voting_->danger : std::min(voting_->alert, voting_->danger));
  std::vector<double> above;
  std::string who;
  std::string silent;
  for (const Source& source : sources_) {
    if (!source.votes) {
      silent += (silent.empty() ? "; bad data: " : ", ") + source.name;
    } else if (source.amplitude > alert.amplitude_limit) {
      above.push_back(source.amplitude);
      who += fmt::format("{}{} {:.3g} mm 0-peak", who.empty() ? "" : ", ", source.name,
                         kMillimetre * source.amplitude);
    }
  }
  // What so many of them agree on.
  std::sort(above.begin(), above.end(), std::greater<>());
  alert.amplitude = above[static_cast<std::size_t>(voting_->agree) - 1];
  alert.text = fmt::format(
      "{}: {} of {} sources above the {} level {:.3g} mm{} ({}{}): {}", system_, above.size(),
      sources_.size(), danger ? "danger" : "alert", kMillimetre * alert.amplitude_limit,
      by != 1.0 ? fmt::format(", multiplied by {:g} during start-up", by) : "", who, silent,
      danger ? "stop the machine or change the speed" : "find the cause or change the speed");
  return alert;
}

void VotedAlarm::tick(double wall_time) {
  for (Source& source : sources_) {
    if (source.votes && source.quality.isStale(wall_time)) {
      source.votes = false;
      alarm_.hold();
    }
  }
}

std::string VotedAlarm::notOk(double wall_time, bool paused) const {
  std::string all;
  for (const Source& source : sources_) {
    const std::string why = source.quality.notOk(wall_time, paused);
    if (!why.empty()) {
      all += fmt::format("{}{} {}", all.empty() ? "not voting: " : "; ", source.name, why);
    }
  }
  return all;
}

}  // namespace whirl_twin

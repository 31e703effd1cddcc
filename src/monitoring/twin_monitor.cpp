#include "monitoring/twin_monitor.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>

#include "messages/alert.h"
#include "messages/names.h"
#include "messages/wall_clock.h"

namespace whirl_twin {

namespace {

std::vector<std::string> namesOf(const std::vector<SharedSystem>& systems) {
  std::vector<std::string> names;
  for (const SharedSystem& system : systems) {
    names.push_back(system->spec.name);
  }
  return names;
}

/// What controllers close around each system.
std::vector<std::shared_ptr<const ClosedLoop>> loopsOf(const Scene& scene) {
  std::vector<std::shared_ptr<const ClosedLoop>> loops(scene.systems.size());
  for (const ClosedLoop& loop : closedLoops(scene)) {
    const auto shared = std::make_shared<const ClosedLoop>(loop);
    for (const std::size_t system : shared->systems()) {
      loops[system] = shared;
    }
  }
  return loops;
}

constexpr std::size_t kLongestDuplicate = 500;  // bytes that an alert shows

/// Of the wall clock, in so many seconds.
std::string clockText(double from_now) {
  return isoTime(wallClock() + std::llround(1.0e9 * from_now));
}

}  // namespace

TwinMonitor::TwinMonitor(const BuiltScene& scene, const AlarmSettings& settings, Judging::Mode mode)
    : settings_(settings),
      loops_(loopsOf(scene.scene)),
      judging_(scene.systems, mode, loops_),
      margin_search_(scene.systems.size(), mode),
      data_lost_alarm_(namesOf(scene.systems), settings),
      lcm_lost_alarm_(settings),
      controller_alarms_(scene.scene, settings),
      alerts_(settings.latch),
      restored_(settings) {
  for (std::size_t i = 0; i < scene.systems.size(); ++i) {
    watches_.emplace_back(scene.systems[i], judging_.speedsOf(i), settings_);
    if (const auto orbit = measuredOrbitOf(scene, i)) {
      watches_.back().measured.emplace(watches_.back().name, *orbit, settings_);
    }
  }
}

void TwinMonitor::restart(double time, double wall_time) {
  time_ = loop_time_ = time;
  ++run_;
  for (const state::Alert& alert : alerts_.active()) {
    alerts_.clear(alert.system, alert.type, time_, "the simulation was reset");
  }
  for (SystemWatch& watch : watches_) {
    watch.restart(settings_);
  }
  data_lost_alarm_ = DataLostAlarm(systemNames(), settings_);
  lcm_lost_alarm_ = LcmLostAlarm(settings_);
  controller_alarms_.restart(settings_);
  for (auto& [source, clock] : clocks_) {
    clock.restartAt(time, wall_time);
  }
  loop_clock_.restartAt(time, wall_time);
  resets_.begin();
  restored_.restart();
  replaced_.clear();
}

void TwinMonitor::set(const AlarmSettings& settings) {
  settings_ = settings;
  for (SystemWatch& watch : watches_) {
    watch.set(settings_);
  }
  data_lost_alarm_.set(settings_);
  lcm_lost_alarm_.set(settings_);
  controller_alarms_.set(settings_);
  restored_.set(settings_);
  alerts_.setLatch(settings_.latch);
}

SystemWatch* TwinMonitor::find(const std::string& system) {
  const auto found = std::find_if(watches_.begin(), watches_.end(),
                                  [&](const SystemWatch& watch) { return watch.name == system; });
  return found == watches_.end() ? nullptr : &*found;
}

std::vector<std::string> TwinMonitor::notOk(double wall_time, bool paused) const {
  std::vector<std::string> why;
  for (const SystemWatch& watch : watches_) {
    if (const std::string all = uncertainty(wall_time); !all.empty()) {
      why.push_back(all);
      continue;
    }
    std::string own = watch.isMeasured() ? watch.measured->notOk(wall_time, paused) : "";
    if (own.empty() && (!watch.isMeasured() || watch.quality.heard())) {
      own = watch.quality.notOk(wall_time, paused);
    }
    if (own.empty() && !watch.uncertainty().empty()) {
      own = "cannot be evaluated: " + printable(watch.uncertainty());
    }
    why.push_back(own.empty() ? watch.voted_alarm.notOk(wall_time, paused) : own);
  }
  return why;
}

std::string TwinMonitor::uncertainty(double wall_time) const {
  if (!uncertain_.empty()) {
    return uncertain_;
  }
  return resets_.isAmbiguous(wall_time)
             ? "two twins publish at the same simulated time and cannot be distinguished"
             : "";
}

void TwinMonitor::reportDuplicate(double wall_time) {
  const std::string found = resets_.duplicate(wall_time);
  const bool known = alerts_.find(alert_type::kEverybody, alert_type::kDuplicateTwin) != nullptr;
  if (!found.empty()) {
    state::Alert alert;
    alert.system = alert_type::kEverybody;
    alert.type = alert_type::kDuplicateTwin;
    alert.severity = state::Severity::kWarning;
    alert.time = time_;
    alert.text = printable(found, kLongestDuplicate);
    alerts_.raise(std::move(alert), found);
  } else if (known && !resets_.hasRival(wall_time)) {
    alerts_.clear(alert_type::kEverybody, alert_type::kDuplicateTwin, time_,
                  "only one publisher remains");
  }
}

void TwinMonitor::tick(double wall_time, bool paused) {
  takeJudgements();
  wall_time_ = wall_time;
  reportDuplicate(wall_time);
  for (SystemWatch& watch : watches_) {
    if (paused) {
      continue;
    }
    watch.voted_alarm.tick(wall_time);
    const bool alone = watch.isMeasured() && !watch.quality.heard();
    if (watch.isMeasured() && !watch.measured->isFit(wall_time)) {
      watch.holdMotion();
    }
    if (alone ? !watch.measured->isFit(wall_time) : watch.quality.isStale(wall_time)) {
      isFit(watch, false, time_);
    }
  }
  data_lost_alarm_.tick(wall_time, time_, paused, alerts_);
  liftInhibitions(wall_time);
}

void TwinMonitor::remember(const AlarmMemory& memory) {
  restored_.begin(memory, alerts_);
  for (const state::Alert& alert : memory.alerts) {
    if (alert.type == alert_type::kInhibited || alert.type == alert_type::kTripMultiplied) {
      alerts_.clear(alert.system, alert.type, alert.time,
                    fmt::format("{}: ended when the monitor restarted", alert.system));
    }
  }
}

void TwinMonitor::liftInhibitions(double wall_time) {
  for (auto held = inhibitions_.begin(); held != inhibitions_.end();) {
    if (wall_time >= held->second.until) {
      alerts_.setInhibited(held->first, false);
      alerts_.clear(held->first, alert_type::kInhibited, time_,
                    fmt::format("alerts of {} are active again: inhibited by {} {}", held->first,
                                held->second.by, held->second.times));
      held = inhibitions_.erase(held);
    } else {
      ++held;
    }
  }
  reportInhibitions();
}

void TwinMonitor::reportInhibitions() {
  for (const auto& [system, held] : inhibitions_) {
    const std::string text =
        fmt::format("alerts of {} are inhibited by {} {}", system, held.by, held.times);
    const state::Alert* const known = alerts_.find(system, alert_type::kInhibited);
    if (known == nullptr || known->text != text) {
      state::Alert alert;
      alert.type = alert_type::kInhibited;
      alert.system = system;
      alert.severity = state::Severity::kWarning;
      alert.time = time_;
      alert.text = text;
      alerts_.raise(alert, text);
    }
  }
}

std::optional<double> TwinMonitor::inhibit(const std::string& system, double duration,
                                           double wall_time, const std::string& by) {
  if (!system.empty() && find(system) == nullptr) {
    return std::nullopt;
  }
  const double lasts = std::min(duration, settings_.max_inhibition);
  const std::string times =
      lasts > 0.0 ? fmt::format("since {} until {}", clockText(0.0), clockText(lasts)) : "";
  for (const SystemWatch& watch : watches_) {
    const bool held = inhibitions_.count(watch.name) > 0;
    if ((system.empty() || watch.name == system) && (lasts > 0.0 || held)) {
      if (lasts > 0.0) {
        inhibitions_[watch.name] = {wall_time + lasts, by, times};
      } else {
        inhibitions_[watch.name].until = wall_time;
        inhibitions_[watch.name].times += fmt::format(", ended by {} at {}", by, clockText(0.0));
      }
      alerts_.setInhibited(watch.name, true);
    }
  }
  liftInhibitions(wall_time);  // a duration of 0 ends now
  return lasts;
}

std::string TwinMonitor::heldBack() const {
  std::vector<std::string> systems;
  for (const auto& [system, held] : inhibitions_) {
    systems.push_back(system);
  }
  return systems.empty()
             ? ""
             : fmt::format("alerts of {} are inhibited by {} {}", fmt::join(systems, ", "),
                           inhibitions_.begin()->second.by, inhibitions_.begin()->second.times);
}

bool TwinMonitor::measures(const std::string& system) const {
  return std::any_of(watches_.begin(), watches_.end(), [&](const SystemWatch& watch) {
    return watch.name == system && watch.isMeasured();
  });
}

std::vector<state::WhirlState> TwinMonitor::measuredMotion(const std::string& system,
                                                           const std::string& source,
                                                           double wall_time) const {
  for (const SystemWatch& watch : watches_) {
    if (watch.name == system && watch.isMeasured() && watch.measured->listensTo(source) &&
        watch.measured->isFit(wall_time)) {
      return watch.measured->motion();
    }
  }
  return {};
}

std::optional<OrderVector> TwinMonitor::slowRoll(const std::string& system) const {
  for (const SystemWatch& watch : watches_) {
    if (watch.name == system && watch.isMeasured()) {
      return watch.measured->slowRoll();
    }
  }
  return std::nullopt;
}

std::vector<std::string> TwinMonitor::systemNames() const {
  std::vector<std::string> names;
  for (const SystemWatch& watch : watches_) {
    names.push_back(watch.name);
  }
  return names;
}

state::MonitorStatus TwinMonitor::status(double wall_time, bool paused) {
  takeJudgements();
  state::MonitorStatus status;
  status.at.step = step_;
  status.at.time = time_;
  status.paused = paused;
  const double busy = judging_.busy();
  if (wall_time > status_at_) {
    status.load = (busy - status_busy_) / (wall_time - status_at_);
  }
  status_at_ = wall_time;
  status_busy_ = busy;
  for (const state::Alert& alert : alerts_.active()) {
    ++status.alerts;
    status.dangers += alert.severity == state::Severity::kDanger ? 1 : 0;
  }
  status.not_ok = notOk(wall_time, paused);
  for (const SystemWatch& watch : watches_) {
    status.system.push_back(watch.name);
    status.verdict_age.push_back(wall_time - watch.verdict_of);
    const auto held = inhibitions_.find(watch.name);
    status.inhibited.push_back(held == inhibitions_.end() ? 0.0 : held->second.until - wall_time);
  }
  return status;
}

}  // namespace whirl_twin

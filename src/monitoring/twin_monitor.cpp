#include "monitoring/twin_monitor.h"

#include <algorithm>

#include "messages/names.h"

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

void TwinMonitor::tick(double wall_time, bool paused) {
  takeJudgements();
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

void TwinMonitor::liftInhibitions(double wall_time) {
  for (auto held = inhibited_until_.begin(); held != inhibited_until_.end();) {
    if (wall_time >= held->second) {
      alerts_.setInhibited(held->first, false);
      held = inhibited_until_.erase(held);
    } else {
      ++held;
    }
  }
}

bool TwinMonitor::inhibit(const std::string& system, double duration, double wall_time) {
  if (!system.empty() && find(system) == nullptr) {
    return false;
  }
  for (const SystemWatch& watch : watches_) {
    if (system.empty() || watch.name == system) {
      inhibited_until_[watch.name] = wall_time + duration;
      alerts_.setInhibited(watch.name, true);
    }
  }
  liftInhibitions(wall_time);  // a duration of 0 ends now
  return true;
}

bool TwinMonitor::measures(const std::string& system) const {
  return std::any_of(watches_.begin(), watches_.end(), [&](const SystemWatch& watch) {
    return watch.name == system && watch.isMeasured();
  });
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
    const auto held = inhibited_until_.find(watch.name);
    status.inhibited.push_back(held == inhibited_until_.end() ? 0.0 : held->second - wall_time);
  }
  return status;
}

}  // namespace whirl_twin

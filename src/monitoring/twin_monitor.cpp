#include "monitoring/twin_monitor.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "messages/alert.h"
#include "messages/names.h"

namespace whirl_twin {
namespace {

constexpr std::size_t kMaxDuplicate = 500;  // bytes that an alert shows

/// The loop that controllers close around each system.
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

std::vector<SystemMonitor> monitorsOf(const BuiltScene& scene, const EvaluationQueue& queue,
                                      const SharedSettings& settings) {
  std::vector<SystemMonitor> systems;
  for (std::size_t i = 0; i < scene.systems.size(); ++i) {
    systems.emplace_back(scene.systems[i], queue.speedsOf(i), settings);
    if (const auto orbit = measuredOrbitOf(scene, i)) {
      systems.back().measured.emplace(systems.back().name, *orbit, *settings);
    }
  }
  return systems;
}

template <class Systems>
auto* findIn(Systems& systems, const std::string& name) {
  const auto found = std::find_if(systems.begin(), systems.end(),
                                  [&](const SystemMonitor& system) { return system.name == name; });
  return found == systems.end() ? nullptr : &*found;
}

}  // namespace

TwinMonitor::TwinMonitor(const BuiltScene& scene, const AlarmSettings& settings,
                         EvaluationQueue::Mode mode)
    : settings_(settings),
      loops_(loopsOf(scene.scene)),
      controllers_(scene.scene.controllers),
      queue_(scene.systems, mode, loops_),
      boundary_search_(scene.systems.size(), mode),
      systems_(monitorsOf(scene, queue_, settings_)),
      alarms_(makeAlarms()),
      alerts_(settings.latch),
      restored_(settings_) {}

TwinMonitor::SceneAlarms TwinMonitor::makeAlarms() const {
  SceneAlarms alarms{{systemNames(), settings_}, LcmLostAlarm(settings_), {}};
  for (const ControllerSpec& controller : controllers_) {
    alarms.controllers.emplace(controller.name, ControllerAlarms(controller, settings_));
  }
  return alarms;
}

void TwinMonitor::restartIfReset() {
  if (!gate_.takeRestart()) {
    return;
  }
  ++run_;
  for (const state::Alert& alert : alerts_.active()) {
    alerts_.clear(alert.system, alert.type, gate_.time(), "the simulation was reset");
  }
  for (SystemMonitor& system : systems_) {
    system.restart(settings_);
  }
  alarms_ = makeAlarms();
  restored_.restart();
  replaced_.clear();
}

void TwinMonitor::set(const AlarmSettings& settings) {
  settings_.replace(settings);
  for (SystemMonitor& system : systems_) {
    system.update(settings);
  }
  alerts_.setLatch(settings.latch);
}

const SystemMonitor* TwinMonitor::find(const std::string& name) const {
  return findIn(systems_, name);
}

SystemMonitor* TwinMonitor::find(const std::string& name) {
  return findIn(systems_, name);
}

std::string TwinMonitor::problemOf(const SystemMonitor& system, double wall_time,
                                   bool paused) const {
  std::string problem = gate_.uncertainty(wall_time);
  if (problem.empty() && system.isMeasured()) {
    problem = system.measured->problem(wall_time, paused);
  }
  if (problem.empty() && (!system.isMeasured() || system.quality.received())) {
    problem = system.quality.problem(wall_time, paused);
  }
  if (problem.empty() && !system.uncertainty().empty()) {
    problem = "cannot be evaluated: " + printable(system.uncertainty());
  }
  return problem.empty() ? system.alarms.voted.problem(wall_time, paused) : problem;
}

std::vector<std::string> TwinMonitor::notOk(double wall_time, bool paused) const {
  std::vector<std::string> problems;
  for (const SystemMonitor& system : systems_) {
    problems.push_back(problemOf(system, wall_time, paused));
  }
  return problems;
}

void TwinMonitor::reportDuplicate(double wall_time) {
  const std::string found = duplicate(wall_time);
  const bool known = alerts_.find(alert_type::kEverybody, alert_type::kDuplicateTwin) != nullptr;
  if (!found.empty()) {
    state::Alert alert;
    alert.system = alert_type::kEverybody;
    alert.type = alert_type::kDuplicateTwin;
    alert.severity = state::Severity::kWarning;
    alert.time = time();
    alert.text = printable(found, kMaxDuplicate);
    alerts_.raise(std::move(alert), found);
  } else if (known && !gate_.run().hasDuplicate(wall_time)) {
    alerts_.clear(alert_type::kEverybody, alert_type::kDuplicateTwin, time(),
                  "only one publisher remains");
  }
}

void TwinMonitor::tick(double wall_time, bool paused) {
  takeResults();
  gate_.setWallTime(wall_time);
  reportDuplicate(wall_time);
  for (SystemMonitor& system : systems_) {
    if (paused) {
      continue;
    }
    system.alarms.voted.tick(wall_time);
    const bool alone = system.isMeasured() && !system.quality.received();
    const bool fit = !system.isMeasured() || system.measured->isFit(wall_time);
    if (!fit) {
      system.alarms.holdMotion();
    }
    if (alone ? !fit : system.quality.isStale(wall_time)) {
      useIf(false, system, time());
    }
  }
  alarms_.data_lost.tick(wall_time, time(), paused, alerts_);
  inhibitions_.update(wall_time, time(), alerts_);
}

void TwinMonitor::remember(const AlarmMemory& memory) {
  restored_.restore(memory, alerts_);
  for (const state::Alert& alert : memory.alerts) {
    if (alert.type == alert_type::kInhibited || alert.type == alert_type::kTripMultiplied) {
      alerts_.clear(alert.system, alert.type, alert.time,
                    fmt::format("{}: ended when the monitor restarted", alert.system));
    }
  }
}

std::optional<double> TwinMonitor::inhibit(const std::string& system, double duration,
                                           double wall_time, const std::string& by) {
  if (!system.empty() && find(system) == nullptr) {
    return std::nullopt;
  }
  const double lasts = std::min(duration, settings_->max_inhibition);
  for (const SystemMonitor& one : systems_) {
    if (system.empty() || one.name == system) {
      inhibitions_.set(one.name, lasts, wall_time, by, alerts_);
    }
  }
  inhibitions_.update(wall_time, time(), alerts_);  // a duration of 0 ends now
  return lasts;
}

bool TwinMonitor::measures(const std::string& system) const {
  const SystemMonitor* const found = find(system);
  return found != nullptr && found->isMeasured();
}

std::vector<state::WhirlState> TwinMonitor::measuredMotion(const std::string& system,
                                                           const std::string& source,
                                                           double wall_time) const {
  const SystemMonitor* const found = find(system);
  const bool usable =
      measures(system) && found->measured->listensTo(source) && found->measured->isFit(wall_time);
  return usable ? found->measured->motion() : std::vector<state::WhirlState>();
}

std::optional<OrderVector> TwinMonitor::slowRoll(const std::string& system) const {
  return measures(system) ? find(system)->measured->slowRoll() : std::nullopt;
}

std::vector<std::string> TwinMonitor::systemNames() const {
  std::vector<std::string> names;
  for (const SystemMonitor& system : systems_) {
    names.push_back(system.name);
  }
  return names;
}

state::MonitorStatus TwinMonitor::status(double wall_time, bool paused) {
  takeResults();
  state::MonitorStatus status;
  status.at.step = gate_.step();
  status.at.time = time();
  status.paused = paused;
  const double busy = queue_.busy();
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
  for (const SystemMonitor& system : systems_) {
    status.system.push_back(system.name);
    status.verdict_age.push_back(wall_time - system.verdict_of);
    status.inhibited.push_back(inhibitions_.remaining(system.name, wall_time));
  }
  return status;
}

}  // namespace whirl_twin

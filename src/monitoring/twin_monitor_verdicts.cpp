// When the monitor requests verdicts, of what, and what it does with them.
#include <algorithm>
#include <cmath>
#include <map>
#include <utility>

#include "messages/input_error.h"
#include "monitoring/twin_monitor.h"

namespace whirl_twin {

namespace {

constexpr double kEvaluationPeriod = 0.1;  // s, simulated
/// [s], wall time: a second twin publishes its parameters before its loop statistics.
constexpr double kUndoWindow = 2.5;

}  // namespace

bool TwinMonitor::take(const state::ParameterChange& change) {
  const double now = gate_.wallTime();
  // Beside a duplicate it is unknown whose they are, and they are published again.
  if (gate_.run().isOfEarlier(change.at.stamp) || gate_.run().hasDuplicate(now)) {
    return true;
  }
  const auto known = parameters_.find(change.system);
  const bool same = known != parameters_.end() && known->second.names == change.names &&
                    known->second.values == change.values;
  if (!apply(change)) {
    return false;
  }
  replaced_.erase(
      std::remove_if(replaced_.begin(), replaced_.end(),
                     [&](const Replaced& one) { return now - one.wall_time > kUndoWindow; }),
      replaced_.end());
  if (!same && known != parameters_.end()) {
    replaced_.push_back({known->second, now});
  }
  parameters_[change.system] = change;
  return true;
}

void TwinMonitor::undoParameters() {
  for (auto one = replaced_.rbegin(); one != replaced_.rend(); ++one) {
    if (gate_.wallTime() - one->wall_time <= kUndoWindow && apply(one->before)) {
      parameters_[one->before.system] = one->before;
    }
  }
  replaced_.clear();
}

bool TwinMonitor::apply(const state::ParameterChange& change) {
  SystemMonitor* const system = find(change.system);
  if (system == nullptr) {
    return applyToController(change);
  }
  SharedSystem changed = system->system->with(change);
  if (changed == nullptr) {
    refuse(change, *system);
    return false;
  }
  system->refused.clear();
  if (changed->dynamics != system->system->dynamics) {  // else they are what they were
    system->system = std::move(changed);
    system->alarms.validity.setDynamics(system->system->dynamics);
    system->alarms.decay.hold();
    if (system->evaluated) {
      request(*system);
    }
  }
  return true;
}

void TwinMonitor::refuse(const state::ParameterChange& change, SystemMonitor& system) {
  if (change.names != system.system->parameters().names) {
    return;  // of another scene
  }
  system.refused = "its reported parameters are invalid";
  try {
    static_cast<void>(system.system->with(change.names, change.values, "parameters"));
  } catch (const InputError& why) {
    system.refused = why.what();
  }
  if (system.evaluated) {
    request(system);
  }
}

bool TwinMonitor::applyToController(const state::ParameterChange& change) {
  const auto loop = std::find_if(loops_.begin(), loops_.end(), [&](const auto& around) {
    return around != nullptr && around->has(change.system);
  });
  if (loop == loops_.end()) {
    return false;
  }
  const std::shared_ptr<const ClosedLoop> before = *loop;
  std::optional<ClosedLoop> next = before->with(change);
  if (!next) {
    return false;
  }
  if (before->parametersOf(change.system).values == change.values) {  // published again
    return true;
  }
  const auto changed = std::make_shared<const ClosedLoop>(std::move(*next));
  for (const std::size_t system : changed->systems()) {
    loops_[system] = changed;
    if (systems_[system].evaluated) {
      request(systems_[system]);
    }
  }
  return true;
}

void TwinMonitor::evaluateStability(SystemMonitor& system, const state::Instant& at,
                                    const std::vector<double>& q, const std::vector<double>& v,
                                    double wall_time) {
  const bool passed = system.speeds.thresholds.between(system.evaluated_speed, system.speed);
  const double since = at.time - system.evaluated_at;  // back where a log is played a second time
  const bool due = since < 0.0 || since >= kEvaluationPeriod * (1.0 - 1.0e-9);
  const bool news = system.system->dynamics->hasShaft() &&
                    std::fabs(system.speed - system.evaluated_speed) >
                        kSpeedNews * std::fabs(system.evaluated_speed) &&
                    at.time - system.news_at >= system.news_break;
  system.last = {at, q, v, wall_time};
  const std::size_t place = placeOf(system);
  if ((system.evaluated && !passed && !due && !news) || !loopIsComplete(place)) {
    return;
  }
  system.news_at = due ? std::fmin(system.news_at, at.time) : at.time;
  request(system);
}

void TwinMonitor::request(SystemMonitor& system) {
  system.evaluated = true;
  system.evaluated_at = system.last.at.time;
  system.evaluated_speed = system.speed;
  if (!system.refused.empty()) {
    takeMargin(uncertainMargin(*system.system, system.last.at, system.last.q, system.speed),
               system);
    return;
  }
  const std::size_t place = placeOf(system);
  queue_.add({place, system.system, system.last.at, system.last.q, system.last.v, system.speed,
              run_, system.last.arrived_at, loops_[place], motionsBeside(place),
              system.acceleration});
  takeResults();
}

SystemMotions TwinMonitor::motionsBeside(std::size_t place) const {
  if (loops_[place] == nullptr || loops_[place]->systems().size() == 1) {
    return nullptr;
  }
  struct Received {
    SharedSystem system;  // whose dynamics the motion refers to
    SystemMotion motion;
  };
  std::map<std::size_t, Received> all;
  for (const std::size_t i : loops_[place]->systems()) {
    const SystemMonitor& one = systems_[i];
    const Dynamics& dynamics = *one.system->dynamics;
    const auto n = static_cast<Eigen::Index>(one.last.q.size());
    all[i] = {
        one.system,
        {&dynamics, Eigen::Map<const Eigen::VectorXd>(one.last.q.data(), n),
         Eigen::Map<const Eigen::VectorXd>(one.last.v.data(), n),
         dynamics.hasShaft() ? one.speed : 0.0, dynamics.hasShaft() ? one.acceleration : 0.0}};
  }
  return [all = std::move(all)](std::size_t system) { return all.at(system).motion; };
}

bool TwinMonitor::loopIsComplete(std::size_t place) const {
  if (loops_[place] == nullptr) {
    return true;
  }
  const std::vector<std::size_t> systems = loops_[place]->systems();
  return std::all_of(systems.begin(), systems.end(),
                     [&](std::size_t i) { return !systems_[i].last.q.empty(); });
}

void TwinMonitor::takeResults() {
  for (StabilityResult& result : queue_.take()) {
    SystemMonitor& system = systems_[result.request.system];
    system.failure = result.failure;
    system.speeds_known = result.speeds || result.failure.empty();
    if (result.speeds) {
      system.speeds = std::move(*result.speeds);
    }
    if (result.request.run == run_) {  // else of before a reset
      if (result.request.loop == nullptr) {
        boundary_search_.addTo(result, system.alarms.stability.slowestDecay());
      }
      system.verdict_of = result.request.arrived_at;
      takeMargin(std::move(result.margin), system);
      for (state::ControllerMargins& margins : result.loop) {
        ControllerAlarms& alarms = alarms_.controllers.at(margins.controller);
        margins.saturated = alarms.saturated();
        margins.missed = alarms.missed();
        alarms.update(margins, alerts_);
        loop_margins_.push_back(std::move(margins));
      }
    }
  }
}

void TwinMonitor::takeMargin(state::StabilityMargin margin, SystemMonitor& system) {
  system.alarms.stability.update(margin, alerts_);
  system.alarms.decay.update(margin);
  margins_.push_back(std::move(margin));
}

std::vector<state::StabilityMargin> TwinMonitor::takeMargins() {
  takeResults();
  return std::exchange(margins_, {});
}

}  // namespace whirl_twin

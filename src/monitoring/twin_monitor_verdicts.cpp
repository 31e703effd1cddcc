// When the monitor asks for verdicts, of what, and what it does with them.
#include <algorithm>
#include <cmath>
#include <map>
#include <utility>

#include "messages/refusal.h"
#include "monitoring/twin_monitor.h"

namespace whirl_twin {

namespace {

constexpr double kJudgingPeriod = 0.1;  // s, simulated
/// [s], wall time: a second twin tells its parameters before its loop statistics.
constexpr double kOfAnotherTwin = 2.5;

}  // namespace

bool TwinMonitor::take(const state::ParameterChange& change) {
  if (resets_.isOfEarlier(change.at.stamp) ||
      resets_.hasRival(wall_time_)) {  // nobody knows whose they are, and they are told again
    return true;
  }
  const auto known = parameters_.find(change.system);
  const bool same = known != parameters_.end() && known->second.names == change.names &&
                    known->second.values == change.values;
  if (!apply(change)) {
    return false;
  }
  replaced_.erase(std::remove_if(replaced_.begin(), replaced_.end(),
                                 [&](const Replaced& one) {
                                   return wall_time_ - one.wall_time > kOfAnotherTwin;
                                 }),
                  replaced_.end());
  if (!same && known != parameters_.end()) {
    replaced_.push_back({known->second, wall_time_});
  }
  parameters_[change.system] = change;
  return true;
}

void TwinMonitor::putBackParameters() {
  for (auto one = replaced_.rbegin(); one != replaced_.rend(); ++one) {
    if (wall_time_ - one->wall_time <= kOfAnotherTwin && apply(one->before)) {
      parameters_[one->before.system] = one->before;
    }
  }
  replaced_.clear();
}

bool TwinMonitor::apply(const state::ParameterChange& change) {
  SystemWatch* watch = find(change.system);
  if (watch == nullptr) {
    return takeOfController(change);
  }
  SharedSystem changed = watch->system->with(change);
  if (changed == nullptr) {
    refuse(change, *watch);
    return false;
  }
  watch->refused.clear();
  if (changed->dynamics != watch->system->dynamics) {  // else they are what they were
    watch->system = std::move(changed);
    watch->validity_alarm.setDynamics(watch->system->dynamics);
    watch->decay_alarm.hold();
    if (watch->judged) {
      askFor(*watch);
    }
  }
  return true;
}

void TwinMonitor::refuse(const state::ParameterChange& change, SystemWatch& watch) {
  if (change.names != watch.system->parameters().names) {
    return;  // of another scene
  }
  watch.refused = "its reported parameters are invalid";
  try {
    static_cast<void>(watch.system->with(change.names, change.values, "parameters"));
  } catch (const Refusal& why) {
    watch.refused = why.what();
  }
  if (watch.judged) {
    askFor(watch);
  }
}

bool TwinMonitor::takeOfController(const state::ParameterChange& change) {
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
  if (before->parametersOf(change.system).values == change.values) {  // told again
    return true;
  }
  const auto changed = std::make_shared<const ClosedLoop>(std::move(*next));
  for (const std::size_t system : changed->systems()) {
    loops_[system] = changed;
    if (watches_[system].judged) {
      askFor(watches_[system]);
    }
  }
  return true;
}

void TwinMonitor::judge(SystemWatch& watch, const state::Instant& at, const std::vector<double>& q,
                        const std::vector<double>& v, double wall_time) {
  const bool passed = watch.speeds.thresholds.between(watch.judged_speed, watch.speed);
  const double since = at.time - watch.judged_at;  // back where a log is played a second time
  const bool due = since < 0.0 || since >= kJudgingPeriod * (1.0 - 1.0e-9);
  const bool news =
      watch.system->dynamics->hasShaft() &&
      std::fabs(watch.speed - watch.judged_speed) > kSpeedNews * std::fabs(watch.judged_speed) &&
      at.time - watch.news_at >= watch.news_break;
  watch.last = {at, q, v, wall_time};
  const auto place = static_cast<std::size_t>(&watch - watches_.data());
  if ((watch.judged && !passed && !due && !news) || !loopHasCome(place)) {
    return;
  }
  watch.news_at = due ? std::fmin(watch.news_at, at.time) : at.time;
  askFor(watch);
}

void TwinMonitor::askFor(SystemWatch& watch) {
  watch.judged = true;
  watch.judged_at = watch.last.at.time;
  watch.judged_speed = watch.speed;
  if (!watch.refused.empty()) {
    take(uncertainMargin(*watch.system, watch.last.at, watch.last.q, watch.speed), watch);
    return;
  }
  const auto place = static_cast<std::size_t>(&watch - watches_.data());
  judging_.ask({place, watch.system, watch.last.at, watch.last.q, watch.last.v, watch.speed, run_,
                watch.last.arrived_at, loops_[place], motionsBeside(place), watch.acceleration});
  takeJudgements();
}

SystemMotions TwinMonitor::motionsBeside(std::size_t place) const {
  if (loops_[place] == nullptr || loops_[place]->systems().size() == 1) {
    return nullptr;
  }
  struct Heard {
    SharedSystem system;  // whose dynamics the motion speaks of
    SystemMotion motion;
  };
  std::map<std::size_t, Heard> all;
  for (const std::size_t i : loops_[place]->systems()) {
    const SystemWatch& watch = watches_[i];
    const Dynamics& dynamics = *watch.system->dynamics;
    const auto n = static_cast<Eigen::Index>(watch.last.q.size());
    all[i] = {
        watch.system,
        {&dynamics, Eigen::Map<const Eigen::VectorXd>(watch.last.q.data(), n),
         Eigen::Map<const Eigen::VectorXd>(watch.last.v.data(), n),
         dynamics.hasShaft() ? watch.speed : 0.0, dynamics.hasShaft() ? watch.acceleration : 0.0}};
  }
  return [all = std::move(all)](std::size_t system) { return all.at(system).motion; };
}

bool TwinMonitor::loopHasCome(std::size_t place) const {
  if (loops_[place] == nullptr) {
    return true;
  }
  const std::vector<std::size_t> systems = loops_[place]->systems();
  return std::all_of(systems.begin(), systems.end(),
                     [&](std::size_t i) { return !watches_[i].last.q.empty(); });
}

void TwinMonitor::takeJudgements() {
  for (Judgement& judgement : judging_.take()) {
    SystemWatch& watch = watches_[judgement.system];
    watch.failure = judgement.failure;
    watch.speeds_known = judgement.speeds || judgement.failure.empty();
    if (judgement.speeds) {
      watch.speeds = std::move(*judgement.speeds);
    }
    if (judgement.run == run_) {  // else of before a reset
      if (!judgement.of_loop) {
        margin_search_.take(judgement, watch.stability_alarm.slowestDecay());
      }
      watch.verdict_of = judgement.arrived_at;
      take(std::move(judgement.margin), watch);
      takeLoop(std::move(judgement.loop));
    }
  }
}

void TwinMonitor::take(state::StabilityMargin margin, SystemWatch& watch) {
  watch.stability_alarm.update(margin, alerts_);
  watch.decay_alarm.update(margin);
  margins_.push_back(std::move(margin));
}

void TwinMonitor::takeLoop(std::vector<state::ControllerMargins> judged) {
  for (state::ControllerMargins& margins : judged) {
    controller_alarms_.update(margins, alerts_);
    loop_margins_.push_back(std::move(margins));
  }
}

std::vector<state::StabilityMargin> TwinMonitor::takeMargins() {
  takeJudgements();
  return std::exchange(margins_, {});
}

}  // namespace whirl_twin

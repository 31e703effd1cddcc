#include "monitoring/twin_monitor.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <utility>

namespace whirl_twin {

namespace {

constexpr double kJudgingPeriod = 0.1;  // s, simulated
constexpr double kSpeedNews = 0.01;     // of a speed: a change that is judged before its turn
constexpr double kOrdersLate =
    1.0;  // s, simulated, beside the newest state: others are not believed

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

bool TwinMonitor::take(const state::ParameterChange& change) {
  SystemWatch* watch = find(change.system);
  if (watch == nullptr) {
    return takeOfController(change);
  }
  SharedSystem changed = watch->system->with(change);
  if (changed == nullptr) {
    return false;
  }
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

SystemWatch* TwinMonitor::find(const std::string& system) {
  const auto found = std::find_if(watches_.begin(), watches_.end(),
                                  [&](const SystemWatch& watch) { return watch.name == system; });
  return found == watches_.end() ? nullptr : &*found;
}

bool TwinMonitor::votes(const std::string& source) const {
  return std::any_of(watches_.begin(), watches_.end(),
                     [&](const SystemWatch& watch) { return watch.voted_alarm.listensTo(source); });
}

bool TwinMonitor::arrived(const std::string& source, const state::Instant& at, double wall_time) {
  // Each source against itself: one may be seconds ahead of another when the monitor was held up.
  const auto [known, first] = clocks_.try_emplace(source);
  SourceClock& clock = known->second;
  SourceClock::Order order = clock.take(at.time, wall_time, pace_);
  if (order != SourceClock::Order::kInStep && resets_.confirmedBy(at.time, wall_time)) {
    restart(at.time, wall_time);
    order = clock.take(at.time, wall_time, pace_);
  }
  if (order == SourceClock::Order::kOutOfStep) {
    return false;
  }
  const bool anew = order == SourceClock::Order::kFollowed || (first && clocks_.size() == 1);
  if (anew || at.time >= time_) {
    time_ = at.time;
    step_ = at.step;
  }
  data_lost_alarm_.received(source, wall_time, time_, alerts_);
  return true;
}

void TwinMonitor::watchShaft(SystemWatch& watch, state::DriveState shaft) {
  watch.speed = shaft.speed;
  watch.acceleration = shaft.acceleration;
  if (watch.spin >= 0) {  // a motor has no target: it goes on as it accelerates
    shaft.target_speed = std::numeric_limits<double>::quiet_NaN();
  }
  watch.capture_alarm.update(shaft, watch.speeds.captures, alerts_);
  watch.critical_speed_alarm.update(shaft, watch.speeds.marginsAt(shaft.speed), alerts_);
}

bool TwinMonitor::isFit(SystemWatch& watch, bool fit, double time) {
  if (fit) {
    restored_.heard(watch.name, time, alerts_);
  } else {
    restored_.interrupted(watch.name);
    watch.hold();
  }
  return fit;
}

std::vector<std::string> TwinMonitor::notOk(double wall_time, bool paused) const {
  std::vector<std::string> why;
  for (const SystemWatch& watch : watches_) {
    std::string own = watch.isMeasured() ? watch.measured->notOk(wall_time, paused) : "";
    if (own.empty() && (!watch.isMeasured() || watch.quality.heard())) {
      own = watch.quality.notOk(wall_time, paused);
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
  const auto place = static_cast<std::size_t>(&watch - watches_.data());
  judging_.ask({place, watch.system, watch.last.at, watch.last.q, watch.last.v, watch.speed, run_,
                watch.last.arrived_at, loops_[place], motionsBeside(place)});
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
    all[i] = {watch.system,
              {&dynamics, Eigen::Map<const Eigen::VectorXd>(watch.last.q.data(), n),
               Eigen::Map<const Eigen::VectorXd>(watch.last.v.data(), n),
               dynamics.hasShaft() ? watch.speed : 0.0}};
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
    if (judgement.speeds) {
      watch.speeds = std::move(*judgement.speeds);
    }
    if (judgement.run == run_) {  // else of before a reset
      if (!judgement.of_loop) {
        margin_search_.take(judgement, watch.stability_alarm.slowestDecay());
      }
      watch.verdict_of = judgement.arrived_at;
      watch.stability_alarm.update(judgement.margin, alerts_);
      watch.decay_alarm.update(judgement.margin);
      margins_.push_back(std::move(judgement.margin));
      takeLoop(std::move(judgement.loop));
    }
  }
}

void TwinMonitor::takeLoop(std::vector<state::ControllerMargins> judged) {
  for (state::ControllerMargins& margins : judged) {
    controller_alarms_.update(margins, alerts_);
    loop_margins_.push_back(std::move(margins));
  }
}

void TwinMonitor::take(const state::WhirlState& whirl, double wall_time) {
  SystemWatch* watch = find(whirl.system);
  const bool watched = watch != nullptr && watch->rotor;
  if ((!watched && !votes(whirl.system)) || !arrived(whirl.system, whirl.at, wall_time)) {
    return;
  }
  for (SystemWatch& asking : watches_) {
    if (asking.voted_alarm.listensTo(whirl.system)) {
      asking.voted_alarm.take(whirl, asking.acceleration, wall_time, alerts_);
    }
  }
  if (!watched || !isFit(*watch, watch->quality.take(whirl, wall_time), whirl.at.time)) {
    return;
  }
  if (watch->drive.empty()) {
    state::DriveState shaft;
    shaft.at = whirl.at;
    shaft.speed = shaft.target_speed = whirl.speed;
    watchShaft(*watch, shaft);
  }
  watch->speed = whirl.speed;
  if (!watch->isMeasured()) {
    watchMotion(*watch, whirl);
  }
  watch->state_alarm.updateEnergy(whirl.at.time, whirl.energy_residual, alerts_);
  judge(*watch, whirl.at, watch->coordinates(whirl.x, whirl.y, whirl.shaft_angle),
        watch->coordinates(whirl.x_rate, whirl.y_rate, whirl.speed), wall_time);
}

void TwinMonitor::watchMotion(SystemWatch& watch, const state::WhirlState& whirl) {
  watch.amplitude_alarm.update(whirl.at.time, whirl.radius, whirl.speed, watch.acceleration,
                               alerts_);
  watch.decay_alarm.update(whirl, alerts_);
}

void TwinMonitor::take(const state::PendulumState& pendulum, double wall_time) {
  SystemWatch* watch = find(pendulum.system);
  if (watch == nullptr || watch->rotor || pendulum.angle.size() != watch->dof ||
      pendulum.rate.size() != watch->dof) {
    return;
  }
  if (!arrived(pendulum.system, pendulum.at, wall_time) ||
      !isFit(*watch, watch->quality.take(pendulum, wall_time), pendulum.at.time)) {
    return;
  }
  watch->state_alarm.updateEnergy(pendulum.at.time, pendulum.energy_residual, alerts_);
  if (watch->spin >= 0) {
    watchShaft(*watch, watch->shaftOf(pendulum));
  }
  const auto n = static_cast<Eigen::Index>(watch->dof);
  watch->validity_alarm.update(Eigen::Map<const Eigen::VectorXd>(pendulum.angle.data(), n),
                               Eigen::Map<const Eigen::VectorXd>(pendulum.rate.data(), n),
                               {pendulum.at.time, 0.0, watch->speed, 0.0}, alerts_);
  judge(*watch, pendulum.at, pendulum.angle, pendulum.rate, wall_time);
}

void TwinMonitor::take(const state::DriveState& drive, double wall_time) {
  bool known = false;
  for (SystemWatch& watch : watches_) {
    if (watch.drive != drive.drive) {
      continue;
    }
    // A system may have the same name.
    if (!known && !arrived("drives/" + drive.drive, drive.at, wall_time)) {
      return;
    }
    known = true;
    watchShaft(watch, drive);
  }
}

void TwinMonitor::take(const state::OrderState& orders, double wall_time) {
  SystemWatch* watch = find(orders.system);
  // By the clock of the states, not one of their own: a gap in orders is no loss of data.
  if (watch != nullptr && watch->rotor && !watch->isMeasured() &&
      watch->quality.notOk(wall_time, false).empty() &&
      std::fabs(orders.at.time - time_) < kOrdersLate) {
    watch->order_alarm.update(orders, watch->acceleration, alerts_);
  }
}

void TwinMonitor::take(const state::FollowState& follow, double wall_time) {
  SystemWatch* watch = find(follow.system);
  // By a clock of its own: where no states come any more it says why.
  if (watch != nullptr && arrived("follow/" + follow.system, follow.at, wall_time)) {
    watch->following_alarm.update(follow, watch->decay_alarm.active(), alerts_);
  }
}

void TwinMonitor::take(const state::ControllerState& controller, double wall_time) {
  if (controller_alarms_.watch(controller.controller) &&
      arrived("controllers/" + controller.controller, controller.at, wall_time)) {
    controller_alarms_.update(controller, alerts_);
    restored_.heard(controller.controller, controller.at.time, alerts_);
  }
}

void TwinMonitor::take(const state::Measurement& measurement, double wall_time) {
  bool believed = false;
  for (SystemWatch& watch : watches_) {
    if (!watch.measured || !watch.measured->listensTo(measurement.source)) {
      continue;
    }
    if (!believed && !arrived("measured/" + measurement.source, measurement.at, wall_time)) {
      return;
    }
    believed = true;
    watch.measured->take(measurement, wall_time);
    takeMeasured(watch, wall_time);
  }
}

void TwinMonitor::takeMeasured(SystemWatch& watch, double wall_time) {
  const MeasuredSignal& signal = *watch.measured;
  const bool alone = !watch.quality.heard();  // no twin runs beside it
  const bool fit = signal.isFit(wall_time);
  if (alone) {
    data_lost_alarm_.received(watch.name, wall_time, time_, alerts_);
    isFit(watch, fit, time_);
  } else if (!fit) {
    watch.holdMotion();
  }
  if (!fit || signal.motion().empty()) {
    return;
  }
  const state::WhirlState& newest = signal.motion().back();
  if (alone && newest.speed != 0.0) {
    state::DriveState shaft;
    shaft.at = newest.at;
    shaft.speed = newest.speed;
    shaft.acceleration = signal.acceleration();
    shaft.target_speed = std::numeric_limits<double>::quiet_NaN();  // nobody has told
    if (watch.drive.empty() || clocks_.count("drives/" + watch.drive) == 0) {
      watchShaft(watch, shaft);
    }
    // Its velocity is not measured; a steady motion is looked for from where it is.
    judge(watch, newest.at, watch.coordinates(newest.x, newest.y, newest.shaft_angle),
          watch.coordinates(0.0, 0.0, newest.speed), wall_time);
  }
  for (const state::WhirlState& whirl : signal.motion()) {
    watchMotion(watch, whirl);
  }
  for (const state::OrderState& orders : signal.orders()) {
    watch.order_alarm.update(orders, watch.acceleration, alerts_);
    orders_.push_back(orders);
    orders_.back().system += "_measured";
  }
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

bool TwinMonitor::take(const state::LoopStatistics& loop, double wall_time) {
  if (resets_.take(loop, wall_time)) {
    restart(loop.at.time, wall_time);
  }
  // In a pause time stands still, and the statistics go on.
  const double time = loop.at.time;
  const double pace = std::fmax(1.0, std::fmax(loop.real_time_factor, loop.achieved_factor));
  if (time != loop_time_ &&
      loop_clock_.take(time, wall_time, pace) == SourceClock::Order::kOutOfStep) {
    return false;
  }
  pace_ = pace;
  loop_time_ = time;
  for (std::size_t i = 0; i < loop.system.size(); ++i) {
    if (SystemWatch* watch = find(loop.system[i])) {
      watch->state_alarm.updateStopped(time, static_cast<StepStatus>(loop.stopped[i]),
                                       loop.stopped_why[i], alerts_);
      watch->state_alarm.updateAccuracy(time, loop.error_estimate[i], loop.tolerance[i], alerts_);
    }
  }
  lcm_lost_alarm_.update(wall_time, time, loop.lcm_failed, alerts_);
  restored_.heard(loop, alerts_);
  return true;
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

std::vector<state::StabilityMargin> TwinMonitor::takeMargins() {
  takeJudgements();
  return std::exchange(margins_, {});
}

}  // namespace whirl_twin

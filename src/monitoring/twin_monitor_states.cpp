// What the monitor does with states as they arrive.
#include <algorithm>
#include <cmath>

#include "algebra/constants.h"
#include "monitoring/twin_monitor.h"

namespace whirl_twin {
namespace {

/// [s], simulated, beside the newest state: others are not used.
constexpr double kOrdersLate = 1.0;

Eigen::Map<const Eigen::VectorXd> mapped(const std::vector<double>& values) {
  return {values.data(), static_cast<Eigen::Index>(values.size())};
}

}  // namespace

bool TwinMonitor::votes(const std::string& source) const {
  return std::any_of(systems_.begin(), systems_.end(), [&](const SystemMonitor& system) {
    return system.alarms.voted.listensTo(source);
  });
}

bool TwinMonitor::accept(const std::string& source, const state::Instant& at, double wall_time) {
  const bool accepted = gate_.accept(source, at, wall_time);
  restartIfReset();
  if (accepted) {
    alarms_.data_lost.received(source, wall_time, time(), alerts_);
  }
  return accepted && gate_.uncertainty(wall_time).empty();
}

bool TwinMonitor::useIf(bool good, SystemMonitor& system, double time) {
  if (good && system.uncertainty().empty()) {
    restored_.received(system.name, time, alerts_);
  } else {
    restored_.interrupted(system.name);
  }
  if (!good) {
    system.alarms.hold();
  }
  return good;
}

void TwinMonitor::evaluateShaft(SystemMonitor& system, state::DriveState shaft) {
  SystemAlarms& alarms = system.alarms;
  system.speed = shaft.speed;
  system.acceleration = shaft.acceleration;
  alarms.start_up.update(shaft, alerts_);
  if (system.spin >= 0) {  // a motor has no target: its acceleration continues
    shaft.target_speed = kNaN;
  }
  if (!system.knowsSpeeds()) {
    alarms.capture.hold();
    alarms.critical_speed.hold();
    return;
  }
  alarms.capture.update(shaft, system.speeds.captures, alerts_);
  alarms.critical_speed.update(shaft, system.speeds.marginsAt(shaft.speed), alerts_);
}

void TwinMonitor::evaluateMotion(SystemMonitor& system, const state::WhirlState& whirl) {
  system.alarms.amplitude.update(whirl.at.time, system.vibration.take(whirl), whirl.speed,
                                 system.acceleration, alerts_);
  system.alarms.decay.update(whirl, alerts_);
}

void TwinMonitor::take(const state::WhirlState& whirl, double wall_time) {
  SystemMonitor* const system = find(whirl.system);
  const bool monitored = system != nullptr && system->rotor;
  if ((!monitored && !votes(whirl.system)) || !accept(whirl.system, whirl.at, wall_time)) {
    return;
  }
  for (SystemMonitor& voting : systems_) {
    if (voting.alarms.voted.listensTo(whirl.system)) {
      voting.alarms.voted.update(whirl, voting.acceleration, wall_time, alerts_);
    }
  }
  if (!monitored || !useIf(system->quality.take(whirl, wall_time), *system, whirl.at.time)) {
    return;
  }
  if (system->drive.empty()) {
    state::DriveState shaft;
    shaft.at = whirl.at;
    shaft.speed = shaft.target_speed = whirl.speed;
    evaluateShaft(*system, shaft);
  }
  system->speed = whirl.speed;
  if (!system->isMeasured()) {
    evaluateMotion(*system, whirl);
  }
  system->alarms.state.updateEnergy(whirl.at.time, whirl.energy_residual, alerts_);
  evaluateStability(*system, whirl.at, system->coordinates(whirl.x, whirl.y, whirl.shaft_angle),
                    system->coordinates(whirl.x_rate, whirl.y_rate, whirl.speed), wall_time);
}

void TwinMonitor::take(const state::PendulumState& pendulum, double wall_time) {
  SystemMonitor* const system = find(pendulum.system);
  const state::Instant& at = pendulum.at;
  if (system == nullptr || system->rotor || pendulum.angle.size() != system->dof ||
      pendulum.rate.size() != system->dof || !accept(pendulum.system, at, wall_time) ||
      !useIf(system->quality.take(pendulum, wall_time), *system, at.time)) {
    return;
  }
  system->alarms.state.updateEnergy(at.time, pendulum.energy_residual, alerts_);
  if (system->spin >= 0) {
    evaluateShaft(*system, system->shaftOf(pendulum));
  }
  system->alarms.validity.update(mapped(pendulum.angle), mapped(pendulum.rate),
                                 {at.time, 0.0, system->speed, 0.0}, alerts_);
  evaluateStability(*system, at, pendulum.angle, pendulum.rate, wall_time);
}

void TwinMonitor::take(const state::DriveState& drive, double wall_time) {
  bool accepted = false;
  for (SystemMonitor& system : systems_) {
    if (system.drive != drive.drive) {
      continue;
    }
    // A system may have the same name.
    if (!accepted && !accept("drives/" + drive.drive, drive.at, wall_time)) {
      return;
    }
    accepted = true;
    evaluateShaft(system, drive);
  }
}

void TwinMonitor::take(const state::OrderState& orders, double wall_time) {
  SystemMonitor* const system = find(orders.system);
  // By the clock of the states, not one of their own: a gap in orders is no loss of data.
  if (system != nullptr && system->rotor && !system->isMeasured() &&
      system->quality.problem(wall_time, false).empty() &&
      std::fabs(orders.at.time - time()) < kOrdersLate && gate_.uncertainty(wall_time).empty()) {
    system->alarms.order.update(orders, system->acceleration, alerts_);
  }
}

void TwinMonitor::take(const state::FollowState& follow, double wall_time) {
  SystemMonitor* const system = find(follow.system);
  // By a clock of its own: where no states come any more it reports why.
  if (system != nullptr && accept("follow/" + follow.system, follow.at, wall_time)) {
    system->alarms.estimator.update(follow, system->alarms.decay.active(), alerts_);
  }
}

void TwinMonitor::take(const state::ControllerState& controller, double wall_time) {
  if (alarms_.controllers.count(controller.controller) > 0 &&
      accept("controllers/" + controller.controller, controller.at, wall_time)) {
    alarms_.controllers.at(controller.controller).update(controller, alerts_);
    restored_.received(controller.controller, controller.at.time, alerts_);
  }
}

void TwinMonitor::take(const state::Measurement& measurement, double wall_time) {
  bool accepted = false;
  for (SystemMonitor& system : systems_) {
    if (!system.measured || !system.measured->listensTo(measurement.source)) {
      continue;
    }
    if (!accepted && !accept("measured/" + measurement.source, measurement.at, wall_time)) {
      return;
    }
    accepted = true;
    system.measured->take(measurement, wall_time);
    evaluateMeasured(system, wall_time);
  }
}

void TwinMonitor::evaluateMeasured(SystemMonitor& system, double wall_time) {
  const MeasuredSignal& signal = *system.measured;
  const bool alone = !system.quality.received();  // no twin runs beside it
  const bool fit = signal.isFit(wall_time);
  if (alone) {
    alarms_.data_lost.received(system.name, wall_time, time(), alerts_);
    useIf(fit, system, time());
  } else if (!fit) {
    system.alarms.holdMotion();
  }
  if (!fit || signal.motion().empty()) {
    return;
  }
  const state::WhirlState& newest = signal.motion().back();
  if (alone && newest.speed != 0.0) {
    if (system.drive.empty() || !gate_.hasReceived("drives/" + system.drive)) {
      state::DriveState shaft;
      shaft.at = newest.at;
      shaft.speed = newest.speed;
      shaft.acceleration = signal.acceleration();
      shaft.target_speed = kNaN;  // unknown
      evaluateShaft(system, shaft);
    }
    // Its velocity is not measured; a steady motion is searched for from where it is.
    evaluateStability(system, newest.at, system.coordinates(newest.x, newest.y, newest.shaft_angle),
                      system.coordinates(0.0, 0.0, newest.speed), wall_time);
  }
  for (const state::WhirlState& whirl : signal.motion()) {
    evaluateMotion(system, whirl);
  }
  for (const state::OrderState& orders : signal.orders()) {
    system.alarms.order.update(orders, system.acceleration, alerts_);
    orders_.push_back(orders);
    orders_.back().system += "_measured";
  }
}

bool TwinMonitor::take(const state::LoopStatistics& loop, double wall_time) {
  const StateGate::Result result = gate_.accept(loop, wall_time);
  restartIfReset();
  if (result == StateGate::Result::kNewDuplicate) {
    undoParameters();
  }
  if (result != StateGate::Result::kAccepted) {
    return false;
  }
  const double time = loop.at.time;
  for (std::size_t i = 0; gate_.isCertain() && i < loop.system.size(); ++i) {
    if (SystemMonitor* const system = find(loop.system[i])) {
      StateAlarm& alarm = system->alarms.state;
      alarm.updateStopped(time, static_cast<StepStatus>(loop.stopped[i]), loop.stopped_why[i],
                          alerts_);
      alarm.updateAccuracy(time, loop.error_estimate[i], loop.tolerance[i], alerts_);
    }
  }
  alarms_.lcm_lost.update(wall_time, time, loop.lcm_failed, alerts_);
  restored_.received(loop, alerts_);
  return true;
}

}  // namespace whirl_twin

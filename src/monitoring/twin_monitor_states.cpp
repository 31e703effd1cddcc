// What the monitor does with states as they arrive.
#include <fmt/format.h>

#include <cmath>
#include <limits>

#include "messages/alert.h"
#include "monitoring/twin_monitor.h"

namespace whirl_twin {

namespace {

/// [s], simulated, beside the newest state: others are not believed.
constexpr double kOrdersLate = 1.0;

}  // namespace

bool TwinMonitor::votes(const std::string& source) const {
  return std::any_of(watches_.begin(), watches_.end(),
                     [&](const SystemWatch& watch) { return watch.voted_alarm.listensTo(source); });
}

bool TwinMonitor::arrived(const std::string& source, const state::Instant& at, double wall_time) {
  wall_time_ = wall_time;
  // What sensors and followers tell has the stamps of their machine.
  const bool of_twin = source.rfind("measured/", 0) != 0 && source.rfind("follow/", 0) != 0;
  if (of_twin && resets_.takeStamp(at.stamp, wall_time)) {
    return false;
  }
  if (resets_.isOfRival(at.time, wall_time)) {
    if (!resets_.confirmedBy(at.time, wall_time)) {
      return false;
    }
    restart(at.time, wall_time);
  }
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
  return uncertainty(wall_time).empty();
}

void TwinMonitor::watchShaft(SystemWatch& watch, state::DriveState shaft) {
  watch.speed = shaft.speed;
  watch.acceleration = shaft.acceleration;
  reportStartUp(watch, shaft);
  if (watch.spin >= 0) {  // a motor has no target: it goes on as it accelerates
    shaft.target_speed = std::numeric_limits<double>::quiet_NaN();
  }
  if (!watch.knowsSpeeds()) {
    watch.capture_alarm.hold();
    watch.critical_speed_alarm.hold();
    return;
  }
  watch.capture_alarm.update(shaft, watch.speeds.captures, alerts_);
  watch.critical_speed_alarm.update(shaft, watch.speeds.marginsAt(shaft.speed), alerts_);
}

void TwinMonitor::reportStartUp(SystemWatch& watch, const state::DriveState& shaft) {
  const double times = watch.start_up.multiplier(shaft.at.time, shaft.speed, shaft.acceleration);
  const bool known = alerts_.find(watch.name, alert_type::kTripMultiplied) != nullptr;
  if (times > 1.0 && watch.has_levels && !known) {
    state::Alert alert;
    alert.type = alert_type::kTripMultiplied;
    alert.system = watch.name;
    alert.time = shaft.at.time;
    alert.stamp = shaft.at.stamp;
    alert.speed = shaft.speed;
    alert.acceleration = shaft.acceleration;
    alert.text = fmt::format(
        "{}: amplitude levels and zones are multiplied by {:g} during start-up, for at most {:g} s",
        watch.name, times, settings_.max_inhibition);
    alerts_.raise(alert, alert.text);
  } else if (known && !(times > 1.0)) {
    alerts_.clear(
        watch.name, alert_type::kTripMultiplied, shaft.at.time,
        fmt::format("{}: amplitude levels and zones are no longer multiplied", watch.name));
  }
}

bool TwinMonitor::isFit(SystemWatch& watch, bool fit, double time) {
  if (fit && watch.uncertainty().empty()) {
    restored_.heard(watch.name, time, alerts_);
  } else {
    restored_.interrupted(watch.name);
  }
  if (!fit) {
    watch.hold();
  }
  return fit;
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
  watch.amplitude_alarm.update(whirl.at.time, watch.vibration.take(whirl), whirl.speed,
                               watch.acceleration, alerts_);
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
      std::fabs(orders.at.time - time_) < kOrdersLate && uncertainty(wall_time).empty()) {
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

bool TwinMonitor::take(const state::LoopStatistics& loop, double wall_time) {
  wall_time_ = wall_time;
  const bool had_rival = resets_.hasRival(wall_time);
  if (resets_.take(loop, wall_time)) {
    restart(loop.at.time, wall_time);
  }
  if (!resets_.isOfPresent(loop)) {
    if (!had_rival) {
      putBackParameters();
    }
    return false;
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
  for (std::size_t i = 0; uncertain_.empty() && i < loop.system.size(); ++i) {
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

}  // namespace whirl_twin

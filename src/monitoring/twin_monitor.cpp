#include "monitoring/twin_monitor.h"

#include <algorithm>
#include <cmath>
#include <exception>

#include "scene/parameter_paths.h"

namespace whirl_twin {

namespace {

constexpr double kJudgingPeriod = 0.1;  // s, simulated

/// Low damping is a criterion for rotors; a pendulum may swing as long as it likes.
AlarmSettings settingsFor(const Dynamics& dynamics, AlarmSettings settings) {
  if (!dynamics.isRotor()) {
    settings.log_decrement_warning = 0.0;
    settings.decay_rate_alarm = 0.0;
  }
  return settings;
}

std::vector<std::string> systemNames(const Scene& scene) {
  std::vector<std::string> names;
  for (const SystemSpec& system : scene.systems) {
    names.push_back(system.name);
  }
  return names;
}

}  // namespace

TwinMonitor::Watch::Watch(const Twin::Member& member, std::string drive_name,
                          const AlarmSettings& settings)
    : judge(member),
      dynamics(member.dynamics),
      rotor(member.dynamics->isRotor()),
      dof(member.spec.q.size()),
      drive(std::move(drive_name)),
      speed(member.spec.speed.value_or(0.0)),
      critical_speed_alarm(member.spec.name, settings),
      stability_alarm(member.spec.name, settingsFor(*member.dynamics, settings)),
      state_alarm(member.spec.name, settings),
      validity_alarm(member.spec.name, member.dynamics, settings),
      spec(member.spec) {
  if (rotor) {
    station = member.dynamics->stations().front();
    const std::vector<CoordinateInfo> all = member.dynamics->coordinates();
    for (std::size_t k = 0; k < all.size(); ++k) {
      spin = all[k].name == "spin" ? static_cast<Eigen::Index>(k) : spin;
    }
  }
}

std::vector<double> TwinMonitor::Watch::coordinates(double x, double y, double turned) const {
  std::vector<double> all(dof, 0.0);
  for (std::size_t i = 0; i < dof; ++i) {
    const auto k = static_cast<Eigen::Index>(i);
    all[i] = k == spin ? turned
                       : x * station.along_x[k] / station.along_x.squaredNorm() +
                             y * station.along_y[k] / station.along_y.squaredNorm();
  }
  return all;
}

TwinMonitor::TwinMonitor(const Scene& scene, const AlarmSettings& settings)
    : twin_(scene), settings_(settings), data_lost_alarm_(systemNames(scene), settings) {
  for (const Twin::Member& member : twin_.members()) {
    watches_.emplace_back(member, member.spec.drive.value_or(""), settings_);
  }
}

void TwinMonitor::restart() {
  for (const state::Alert& alert : alerts_.active()) {
    alerts_.clear(alert.system, alert.type, time_, "the simulation was reset");
  }
  data_lost_alarm_ = DataLostAlarm(systemNames(twin_.scene()), settings_);
  for (std::size_t i = 0; i < watches_.size(); ++i) {
    Watch& watch = watches_[i];
    watch.critical_speed_alarm = CriticalSpeedAlarm(watch.judge.system(), settings_);
    watch.stability_alarm =
        StabilityAlarm(watch.judge.system(), settingsFor(*twin_.members()[i].dynamics, settings_));
    watch.state_alarm = StateAlarm(watch.judge.system(), settings_);
    watch.validity_alarm = ValidityAlarm(watch.judge.system(), watch.dynamics, settings_);
    watch.judged = false;
  }
  newest_.clear();
}

bool TwinMonitor::take(const state::ParameterChange& change) {
  Watch* watch = find(change.system);
  if (watch == nullptr) {
    return false;
  }
  const auto system = static_cast<std::size_t>(watch - watches_.data());
  const ModelInfo& model = *twin_.members()[system].model;
  SystemSpec spec = watch->spec;
  if (!takeParameters(change, model, spec)) {
    return false;
  }
  if (change.values == parametersOf(model, watch->spec).values) {
    return true;
  }
  try {
    watch->next = twin_.changed(system, spec);
  } catch (const std::exception&) {
    return false;  // values that the model refuses
  }
  watch->spec = spec;
  watch->dynamics = watch->next->dynamics;
  watch->validity_alarm.setDynamics(watch->dynamics);
  return true;
}

TwinMonitor::Watch* TwinMonitor::find(const std::string& system) {
  const auto found = std::find_if(watches_.begin(), watches_.end(), [&](const Watch& watch) {
    return watch.judge.system() == system;
  });
  return found == watches_.end() ? nullptr : &*found;
}

void TwinMonitor::arrived(const std::string& source, const state::Instant& at, double wall_time) {
  // Each source against itself: one may be seconds ahead of another when the monitor was held up.
  const auto before = newest_.find(source);
  if (before != newest_.end() && at.time < before->second) {
    time_ = at.time;
    restart();
  }
  time_ = newest_.empty() ? at.time : std::max(time_, at.time);
  newest_[source] = at.time;
  data_lost_alarm_.received(source, wall_time, time_, alerts_);
}

void TwinMonitor::watchShaft(Watch& watch, const state::DriveState& shaft) {
  watch.speed = shaft.speed;
  watch.critical_speed_alarm.update(shaft, watch.judge.criticalSpeedMargins(shaft.speed), alerts_);
}

void TwinMonitor::tick(double wall_time, bool paused) {
  data_lost_alarm_.tick(wall_time, time_, paused, alerts_);
}

void TwinMonitor::judge(Watch& watch, const state::Instant& at, const std::vector<double>& q,
                        const std::vector<double>& v) {
  const double threshold = watch.judge.instabilitySpeed();
  const bool passed =
      (std::fabs(watch.speed) > threshold) != (std::fabs(watch.judged_speed) > threshold);
  if (watch.judged && !passed && at.time < watch.judged_at + kJudgingPeriod * (1.0 - 1.0e-9)) {
    return;
  }
  if (watch.next) {  // not before: a ramp changes parameters more often than they are judged
    watch.judge = SystemJudge(*watch.next);
    watch.next.reset();
  }
  const state::StabilityMargin margin = watch.judge.judge(at, q, v, watch.speed);
  watch.judged = true;
  watch.judged_at = at.time;
  watch.judged_speed = watch.speed;
  watch.stability_alarm.update(margin, alerts_);
  margins_.push_back(margin);
}

void TwinMonitor::take(const state::WhirlState& whirl, double wall_time) {
  Watch* watch = find(whirl.system);
  if (watch == nullptr || !watch->rotor) {
    return;
  }
  arrived(whirl.system, whirl.at, wall_time);
  if (watch->drive.empty()) {
    state::DriveState shaft;
    shaft.at = whirl.at;
    shaft.speed = shaft.target_speed = whirl.speed;
    watchShaft(*watch, shaft);
  }
  watch->speed = whirl.speed;
  watch->state_alarm.updateEnergy(whirl.at.time, whirl.energy_residual, alerts_);
  judge(*watch, whirl.at, watch->coordinates(whirl.x, whirl.y, whirl.shaft_angle),
        watch->coordinates(whirl.x_rate, whirl.y_rate, whirl.speed));
}

void TwinMonitor::take(const state::PendulumState& pendulum, double wall_time) {
  Watch* watch = find(pendulum.system);
  if (watch == nullptr || watch->rotor || pendulum.angle.size() != watch->dof ||
      pendulum.rate.size() != watch->dof) {
    return;
  }
  arrived(pendulum.system, pendulum.at, wall_time);
  watch->state_alarm.updateEnergy(pendulum.at.time, pendulum.energy_residual, alerts_);
  const auto n = static_cast<Eigen::Index>(watch->dof);
  watch->validity_alarm.update(Eigen::Map<const Eigen::VectorXd>(pendulum.angle.data(), n),
                               Eigen::Map<const Eigen::VectorXd>(pendulum.rate.data(), n),
                               {pendulum.at.time, 0.0, watch->speed, 0.0}, alerts_);
  judge(*watch, pendulum.at, pendulum.angle, pendulum.rate);
}

void TwinMonitor::take(const state::DriveState& drive, double wall_time) {
  bool known = false;
  for (Watch& watch : watches_) {
    if (watch.drive != drive.drive) {
      continue;
    }
    if (!known) {
      arrived("drives/" + drive.drive, drive.at, wall_time);  // a system may have the same name
      known = true;
    }
    watchShaft(watch, drive);
  }
}

void TwinMonitor::takeStopped(const std::string& system, double time, bool stopped,
                              const std::string& why) {
  if (Watch* watch = find(system)) {
    watch->state_alarm.updateFinite(time, stopped, why, alerts_);
  }
}

void TwinMonitor::takeAccuracy(const std::string& system, double time, double estimate,
                               double tolerance) {
  if (Watch* watch = find(system)) {
    watch->state_alarm.updateAccuracy(time, estimate, tolerance, alerts_);
  }
}

std::vector<state::StabilityMargin> TwinMonitor::takeMargins() {
  std::vector<state::StabilityMargin> margins;
  margins.swap(margins_);
  return margins;
}

}  // namespace whirl_twin

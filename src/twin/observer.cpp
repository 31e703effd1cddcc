#include "twin/observer.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "analysis/equilibria.h"

namespace whirl_twin {

namespace {

constexpr double kPi = 3.14159265358979323846;
constexpr double kNaN = std::numeric_limits<double>::quiet_NaN();
/// A radius below this part of the largest so far has no angle worth the name.
constexpr double kSmallestRadius = 1.0e-9;
/// Part of the lowest natural frequency below which the 1X orbit is not told: it divides by the
/// speed.
constexpr double kSlowestOrbit = 0.01;

Eigen::VectorXd vector(const double* x, std::size_t n) {
  return Eigen::Map<const Eigen::VectorXd>(x, static_cast<Eigen::Index>(n));
}

}  // namespace

Observer::Observer(const Twin& twin, std::shared_ptr<SystemGenerations> generations)
    : twin_(twin),
      generations_(generations ? std::move(generations)
                               : std::make_shared<SystemGenerations>(twin)),
      record_(twin.layout().size),
      tracks_(twin.members().size()),
      motors_(twin.scene().drives.size()) {
  twin.write(record_.data());
  observe(std::vector<double>(record_).data());
  tells_only_change_ = false;
}

void Observer::observe(const double* record) {
  const std::int64_t before = step();
  const bool restarted = unpacked(record[RecordLayout::kStep]) < before;
  bool changed = false;
  std::copy(record, record + record_.size(), record_.begin());
  for (std::size_t i = 0; i < tracks_.size(); ++i) {
    if (restarted) {
      restart(i);
    }
    changed = takeGeneration(i) || changed;
    if (status(i) != StepStatus::kOk) {
      if (tracks_[i].stop_reason.empty()) {
        tracks_[i].stop_reason = describeStop(i);
      }
      continue;
    }
    if (isRotor(i)) {
      trackPhase(i);
    }
    trackEnergy(i);
    trackError(i);
  }
  trackMotors();
  tells_only_change_ = changed && step() == before;
}

void Observer::restart(std::size_t system) {
  tracks_[system] = Track{};
}

bool Observer::takeGeneration(std::size_t system) {
  Track& track = tracks_[system];
  const std::size_t n = twin_.members()[system].spec.q.size();
  const std::int64_t generation = unpacked(coordinates(system)[2 * n + 1]);
  if (generation == track.generation) {
    return false;
  }
  const std::shared_ptr<const SystemGeneration> now = generations_->at(system, generation);
  generations_->forgetBefore(system, generation);
  track.generation = generation;
  track.dynamics = now->dynamics;
  track.parameters = now->parameters;
  track.started = false;
  track.scale = track.residual = 0.0;
  if (isRotor(system)) {
    const Dynamics& dynamics = *track.dynamics;
    track.station = dynamics.stations().front();
    const Linearization l =
        linearizationAtRest(dynamics, Eigen::VectorXd::Zero(dynamics.dof()), 0.0);
    track.slowest_orbit = kSlowestOrbit * std::sqrt(std::min(l.stiffness(0, 0) / l.mass(0, 0),
                                                             l.stiffness(1, 1) / l.mass(1, 1)));
  }
  return true;
}

std::int64_t Observer::step() const {
  return unpacked(record_[RecordLayout::kStep]);
}

StepStatus Observer::status(std::size_t system) const {
  return static_cast<StepStatus>(unpacked(record_[twin_.layout().system[system]]));
}

bool Observer::isRotor(std::size_t system) const {
  return twin_.members()[system].dynamics->isRotor();
}

const double* Observer::coordinates(std::size_t system) const {
  return record_.data() + twin_.layout().system[system] + 1;
}

const double* Observer::rates(std::size_t system) const {
  return coordinates(system) + twin_.members()[system].spec.q.size();
}

const double* Observer::driveRecord(std::size_t drive) const {
  return record_.data() + RecordLayout::kDrives + RecordLayout::kDriveSize * drive;
}

Moment<double> Observer::moment(std::size_t system) const {
  const double* shaft = driveRecord(twin_.members()[system].drive);
  return {twin_.seconds(step()), shaft[1], shaft[2], shaft[3]};
}

state::Instant Observer::instant() const {
  return {step(), twin_.seconds(step()), stamp_};
}

Energies Observer::energies(std::size_t system) const {
  const std::size_t n = twin_.members()[system].spec.q.size();
  Eigen::VectorXd q = vector(coordinates(system), n);
  const std::size_t drive = twin_.members()[system].drive;
  if (twin_.isMotor(drive)) {
    q[q.size() - 1] = driveRecord(drive)[1];  // the spin to the last digit, without its whole turns
  }
  return tracks_[system].dynamics->energies(q, vector(rates(system), n), moment(system));
}

void Observer::trackError(std::size_t system) {
  Track& track = tracks_[system];
  const SystemSpec& spec = twin_.members()[system].spec;
  const double sum = record_[twin_.layout().system[system] + 3 + 2 * spec.q.size()];
  const bool anew = std::isnan(track.error_sum) || sum < track.error_sum;
  const double passed = twin_.seconds(step()) - twin_.seconds(track.error_step);
  const double kept =
      std::isnan(track.error) ? 0.0 : track.error * std::exp(-passed / spec.horizon);
  track.error = kept + (anew ? sum : sum - track.error_sum);
  track.error_sum = sum;
  track.error_step = step();
}

void Observer::trackEnergy(std::size_t system) {
  Track& track = tracks_[system];
  const Energies e = energies(system);
  const double work = coordinates(system)[2 * twin_.members()[system].spec.q.size()];
  if (!track.started) {
    track.started = true;
    track.jacobi = e.jacobi - work;
  }
  track.scale = std::max(track.scale, std::fabs(e.kinetic) + std::fabs(e.potential));
  track.residual = track.scale > 0.0 ? (e.jacobi - track.jacobi - work) / track.scale : 0.0;
}

void Observer::trackMotors() {
  for (std::size_t i = 0; i < motors_.size(); ++i) {
    const std::size_t system = twin_.turnedBy(i);
    if (system == Twin::kNoSystem || status(system) != StepStatus::kOk) {
      continue;
    }
    Track& track = tracks_[system];
    if (track.motor_generation != track.generation) {
      track.motor_generation = track.generation;
      motors_[i].restart();
    }
    const double* shaft = driveRecord(i);
    motors_[i].observe(*twin_.scene().drives[i].motor, twin_.seconds(step()), shaft[2], shaft[3],
                       coordinates(system)[2 * twin_.members()[system].spec.q.size()]);
  }
}

std::string Observer::describeStop(std::size_t system) const {
  const Twin::Member& member = twin_.members()[system];
  const std::vector<CoordinateInfo> coordinates_info = member.dynamics->coordinates();
  std::string values;
  for (std::size_t i = 0; i < member.spec.q.size(); ++i) {
    const CoordinateInfo& c = coordinates_info[i];
    values += fmt::format("{}{} = {:.6g} {}, {}_rate = {:.6g} {}/s", i == 0 ? "" : ", ", c.name,
                          coordinates(system)[i], c.unit, c.name, rates(system)[i], c.unit);
  }
  return fmt::format("{}: stopped in step {} (t = {:.9g} s), {}; last good state: {}",
                     member.spec.name, step(), twin_.seconds(step()), describe(status(system)),
                     values);
}

double Observer::energyResidual(std::size_t system) const {
  return tracks_[system].residual;
}

Observer::Whirl Observer::whirlOf(std::size_t system) const {
  const Station& at = tracks_[system].station;
  const auto n = at.along_x.size();
  const Eigen::Map<const Eigen::VectorXd> q(coordinates(system), n);
  const Eigen::Map<const Eigen::VectorXd> v(rates(system), n);
  return {at.along_x.dot(q), at.along_y.dot(q), at.along_x.dot(v), at.along_y.dot(v)};
}

double Observer::whirlRadius(std::size_t system) const {
  const Whirl at = whirlOf(system);
  return std::hypot(at.x, at.y);
}

double Observer::whirlPhase(std::size_t system) const {
  return tracks_[system].phase_valid ? tracks_[system].phase : kNaN;
}

void Observer::trackPhase(std::size_t system) {
  Track& track = tracks_[system];
  const double radius = whirlRadius(system);
  track.largest_radius = std::max(track.largest_radius, radius);
  track.phase_valid = radius > kSmallestRadius * track.largest_radius;
  if (!track.phase_valid) {
    return;
  }
  const Whirl at = whirlOf(system);
  const double unbalance =
      driveRecord(twin_.members()[system].drive)[1] + tracks_[system].dynamics->unbalanceAngle();
  const double lag = unbalance - std::atan2(at.y, at.x);
  const double reference = track.phase_known ? track.phase : 0.0;
  track.phase = reference + std::remainder(lag - reference, 2.0 * kPi);
  track.phase_known = true;
}

state::WhirlState Observer::whirl(std::size_t system) const {
  const Twin::Member& member = twin_.members()[system];
  const Whirl at = whirlOf(system);
  const double* shaft = driveRecord(member.drive);
  state::WhirlState s;
  s.at = instant();
  s.system = member.spec.name;
  s.x = at.x;
  s.y = at.y;
  s.x_rate = at.x_rate;
  s.y_rate = at.y_rate;
  s.radius = whirlRadius(system);
  s.phase_valid = tracks_[system].phase_valid;
  s.phase = whirlPhase(system);
  s.whirl_angle = s.phase_valid ? std::atan2(at.y, at.x) : kNaN;
  s.whirl_rate =
      s.phase_valid ? (at.x * at.y_rate - at.y * at.x_rate) / (s.radius * s.radius) : kNaN;
  s.speed = shaft[2];
  s.shaft_angle = ShaftAngle{unpacked(shaft[0]), shaft[1]}.total();
  s.orbit_major = s.orbit_minor = kNaN;
  if (std::fabs(s.speed) > tracks_[system].slowest_orbit) {
    // z = f e^(iwt) + b e^(-iwt) with z' known too: forward and backward parts of the 1X orbit.
    const double vx = at.x_rate / s.speed;
    const double vy = at.y_rate / s.speed;
    const double forward = 0.5 * std::hypot(at.x + vy, at.y - vx);
    const double backward = 0.5 * std::hypot(at.x - vy, at.y + vx);
    s.orbit_major = forward + backward;
    s.orbit_minor = std::fabs(forward - backward);
    s.forward = forward >= backward;
  }
  s.energy_residual = energyResidual(system);
  return s;
}

state::PendulumState Observer::pendulum(std::size_t system) const {
  const Twin::Member& member = twin_.members()[system];
  const std::size_t n = member.spec.q.size();
  state::PendulumState s;
  s.at = instant();
  s.system = member.spec.name;
  for (const CoordinateInfo& c : member.dynamics->coordinates()) {
    s.name.emplace_back(c.name);
  }
  s.angle.assign(coordinates(system), coordinates(system) + n);
  s.rate.assign(rates(system), rates(system) + n);
  const Energies e = energies(system);
  s.kinetic = e.kinetic;
  s.potential = e.potential;
  s.energy_residual = energyResidual(system);
  return s;
}

state::DriveState Observer::drive(std::size_t drive) const {
  const double* shaft = driveRecord(drive);
  state::DriveState s;
  s.at = instant();
  s.drive = twin_.scene().drives[drive].name;
  s.turns = unpacked(shaft[0]);
  s.remainder = shaft[1];
  s.speed = shaft[2];
  s.acceleration = shaft[3];
  s.jerk = shaft[4];
  s.target_speed = shaft[5];
  s.shaft_angle = ShaftAngle{s.turns, s.remainder}.total();
  return s;
}

state::MotorState Observer::motor(std::size_t drive) const {
  const std::size_t system = twin_.turnedBy(drive);
  const DriveSpec& spec = twin_.scene().drives[drive];
  const double* shaft = driveRecord(drive);
  const Energies e = energies(system);
  state::MotorState s;
  s.at = instant();
  s.drive = spec.name;
  s.system = twin_.members()[system].spec.name;
  s.speed = shaft[2];
  s.acceleration = shaft[3];
  s.torque = spec.motor->torque(s.speed);
  s.motor_power = motors_[drive].power();
  s.drag_power = spec.motor->drag * s.speed * s.speed;
  s.dissipated_power = e.dissipated_power - s.drag_power;
  s.energy = e.kinetic + e.potential;
  s.motor_work = motors_[drive].work();
  s.dissipated_work = motors_[drive].dissipated();
  return s;
}

}  // namespace whirl_twin

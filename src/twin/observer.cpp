#include "twin/observer.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "analysis/equilibria.h"
#include "scene/signal_names.h"
#include "twin/observed_states.h"

namespace whirl_twin {

void EnergyAudit::observe(const Energies& energies, double work) {
  if (!started_) {
    started_ = true;
    start_ = energies.jacobi - work;
  }
  scale_ = std::max(scale_, std::fabs(energies.kinetic) + std::fabs(energies.potential));
  residual_ = scale_ > 0.0 ? (energies.jacobi - start_ - work) / scale_ : 0.0;
}

void ErrorTrack::observe(double time, double sum, double horizon, bool restarted) {
  const double kept = std::isnan(estimate_) ? 0.0 : estimate_ * std::exp(-(time - time_) / horizon);
  const double now = kept + (restarted || std::isnan(sum_) ? sum : sum - sum_);
  estimate_ = now < 0.0 ? 0.0 : now;  // NaN is kept
  sum_ = sum;
  time_ = time;
}

namespace {

/// Fraction of the lowest natural frequency below which the 1X orbit is not published: it is
/// divided by the speed.
constexpr double kSlowestOrbit = 0.01;

constexpr std::uint64_t kMaxReason = 100'000;  // characters

Eigen::VectorXd vector(const double* x, std::size_t n) {
  return Eigen::Map<const Eigen::VectorXd>(x, static_cast<Eigen::Index>(n));
}

}  // namespace

Observer::Observer(const Twin& twin, std::shared_ptr<SystemGenerations> generations)
    : twin_(twin),
      generations_(generations ? std::move(generations)
                               : std::make_shared<SystemGenerations>(twin)),
      record_(twin.layout().size),
      tracks_(twin.systems().size()),
      controller_tracks_(twin.scene().controllers.size()),
      stations_(twin.systems().size()),
      motors_(twin.scene().drives.size()),
      looked_errors_(twin.systems().size(), std::numeric_limits<double>::quiet_NaN()),
      looked_(twin.layout().size) {
  for (std::size_t i = 0; i < stations_.size(); ++i) {
    stations_[i] = publishedStations(twin.systems()[i]->spec.name, *twin.systems()[i]->dynamics);
  }
  prepareLooks();
  twin.write(record_.data());
  observe(std::vector<double>(record_).data());
  tells_only_change_ = false;
}

void Observer::observe(const double* record) {
  const std::int64_t before = step();
  const bool restarted = RecordLayout::step(record) < before;
  bool changed = false;
  std::copy(record, record + record_.size(), record_.begin());
  for (std::size_t i = 0; i < tracks_.size(); ++i) {
    Track& track = tracks_[i];
    if (restarted) {
      track = Track{};
    } else if (isRotor(i) && track.dynamics) {
      track.whirl.settle(step(), shaftOf(i), track.dynamics->phaseMark(),
                         twin_.scene().stepSeconds());
    }
    const bool replaced = takeGeneration(i);
    changed = replaced || changed;
    if (status(i) != StepStatus::kOk) {
      if (track.stop_reason.empty()) {
        track.stop_reason =
            stopText(*twin_.systems()[i], view(i), whyStopped(i), step(), twin_.seconds(step()));
      }
      continue;
    }
    follow(i, replaced);
  }
  changed = takeControllers() || changed;
  followMotors(record_.data());
  tells_only_change_ = changed && step() == before;
}

void Observer::exchange(StateImage& image) {
  image(record_, motors_, looked_errors_, tells_only_change_);
  for (Track& track : tracks_) {
    image(track.whirl, track.energy, track.error, track.motor_generation);
    std::uint64_t length = track.stop_reason.size();
    image(length);
    std::vector<char> reason(track.stop_reason.begin(), track.stop_reason.end());
    reason.resize(std::min(length, kMaxReason));
    image(reason);
    track.stop_reason.assign(reason.begin(), reason.end());
  }
}

std::string Observer::whyStopped(std::size_t system) const {
  if (status(system) != StepStatus::kControllerLost) {
    return describe(status(system));
  }
  // It may have answered again meanwhile.
  std::string why;
  for (std::size_t i = 0; i < controller_tracks_.size(); ++i) {
    const std::string own = describeLost(twin_.scene().controllers[i], system);
    if (!own.empty() && (why.empty() || twin_.layout().controller(record_.data(), i).lost())) {
      why = own;
    }
  }
  return why;
}

bool Observer::takeGeneration(std::size_t system) {
  Track& track = tracks_[system];
  const std::int64_t generation = view(system).generation();
  if (generation == track.generation) {
    return false;
  }
  const std::shared_ptr<const SystemGeneration> now = generations_->at(system, generation);
  generations_->forgetBefore(system, generation);
  track.generation = generation;
  track.dynamics = now->dynamics;
  track.parameters = now->parameters;
  track.energy = {};
  if (isRotor(system)) {
    const Dynamics& dynamics = *track.dynamics;
    takeStations(system);
    const Linearization l =
        linearizationAtRest(dynamics, Eigen::VectorXd::Zero(dynamics.dof()), 0.0);
    track.slowest_orbit = kSlowestOrbit * std::sqrt(std::min(l.stiffness(0, 0) / l.mass(0, 0),
                                                             l.stiffness(1, 1) / l.mass(1, 1)));
  }
  return true;
}

bool Observer::takeControllers() {
  bool changed = false;
  for (std::size_t i = 0; i < controller_tracks_.size(); ++i) {
    ControllerTrack& track = controller_tracks_[i];
    const std::int64_t generation = twin_.layout().controller(record_.data(), i).generation();
    if (generation != track.generation) {
      const std::size_t which = tracks_.size() + i;
      track = {generation, generations_->at(which, generation)->parameters};
      generations_->forgetBefore(which, generation);
      changed = true;
    }
  }
  return changed;
}

/// The published stations of the current dynamics; their phases continue.
void Observer::takeStations(std::size_t system) {
  const std::string& name = twin_.systems()[system]->spec.name;
  const std::vector<Station> all = tracks_[system].dynamics->stations();
  std::vector<Station> published{all.front()};
  for (std::size_t k = 1; k < stations_[system].size(); ++k) {
    const auto is_it = [&](const Station& s) {
      return stationName(name, s) == stations_[system][k];
    };
    published.push_back(*std::find_if(all.begin(), all.end(), is_it));
  }
  tracks_[system].whirl.put(published);
}

void Observer::follow(std::size_t system, bool restarted) {
  Track& track = tracks_[system];
  const SystemView now = view(system);
  if (isRotor(system)) {
    track.whirl.observe(step(), now.q(), now.v(),
                        {shaftOf(system).angle(), track.dynamics->phaseMark()});
  }
  track.energy.observe(energies(system), now.work());
  track.error.observe(twin_.seconds(step()), now.errorSum(), twin_.systems()[system]->spec.horizon,
                      restarted);
}

SystemView Observer::view(std::size_t system) const {
  return twin_.layout().system(record_.data(), system);
}

ShaftView Observer::shaft(std::size_t drive) const {
  return RecordLayout::shaft(record_.data(), drive);
}

ShaftView Observer::shaftOf(std::size_t system) const {
  return shaft(twin_.systems()[system]->drive);
}

std::int64_t Observer::step() const {
  return RecordLayout::step(record_.data());
}

StepStatus Observer::status(std::size_t system) const {
  return view(system).status();
}

bool Observer::isRotor(std::size_t system) const {
  return twin_.systems()[system]->dynamics->isRotor();
}

const double* Observer::coordinates(std::size_t system) const {
  return view(system).q();
}

const double* Observer::rates(std::size_t system) const {
  return view(system).v();
}

EvaluationPoint<double> Observer::moment(std::size_t system) const {
  const ShaftView now = shaftOf(system);
  return {twin_.seconds(step()), now.remainder(), now.speed(), now.acceleration()};
}

state::Instant Observer::instant() const {
  return {step(), twin_.seconds(step()), stamp_};
}

Energies Observer::energies(std::size_t system) const {
  const SystemView now = view(system);
  Eigen::VectorXd q = vector(now.q(), now.dof());
  if (twin_.isMotor(twin_.systems()[system]->drive)) {
    // The spin, the last coordinate: exact to the last digit, without whole turns.
    q[q.size() - 1] = shaftOf(system).remainder();
  }
  return tracks_[system].dynamics->energies(q, vector(now.v(), now.dof()), moment(system));
}

double Observer::energyResidual(std::size_t system) const {
  return tracks_[system].energy.residual();
}

WhirlMotion Observer::whirlOf(std::size_t system, std::size_t station) const {
  return tracks_[system].whirl.motion(station, coordinates(system), rates(system));
}

OrbitSample Observer::orbitSample(const double* record, std::size_t system,
                                  std::size_t station) const {
  const Track& track = tracks_[system];
  const Station& at = track.whirl.station(station);
  const SystemView now = twin_.layout().system(record, system);
  const ShaftView shaft = RecordLayout::shaft(record, twin_.systems()[system]->drive);
  const Eigen::Map<const Eigen::VectorXd> q(now.q(), at.along_x.size());
  OrbitSample sample;
  sample.index = RecordLayout::step(record);
  sample.time = twin_.seconds(sample.index);
  sample.turns = shaft.turns();
  sample.remainder = shaft.remainder() + track.dynamics->phaseMark();
  sample.speed = shaft.speed();
  const bool runs = now.status() == StepStatus::kOk;
  sample.x = runs ? at.along_x.dot(q) : std::numeric_limits<double>::quiet_NaN();
  sample.y = runs ? at.along_y.dot(q) : std::numeric_limits<double>::quiet_NaN();
  return sample;
}

state::ControllerState Observer::controller(std::size_t controller) const {
  const ControllerSpec& spec = twin_.scene().controllers[controller];
  state::ControllerState state =
      controllerState(spec, twin_.scene(), twin_.layout().controller(record_.data(), controller));
  state.at = instant();
  return state;
}

double Observer::whirlRadius(std::size_t system) const {
  return whirlOf(system).radius();
}

double Observer::whirlPhase(std::size_t system) const {
  return tracks_[system].whirl.phase(0).lag();
}

state::WhirlState Observer::whirl(std::size_t system, std::size_t station) const {
  const Track& track = tracks_[system];
  state::WhirlState s = whirlState(whirlOf(system, station), track.whirl.phase(station),
                                   shaftOf(system), track.slowest_orbit);
  s.at = instant();
  s.system = stations_[system][station];
  s.energy_residual = energyResidual(system);
  return s;
}

state::PendulumState Observer::pendulum(std::size_t system) const {
  const BuiltSystem& built = *twin_.systems()[system];
  state::PendulumState s =
      pendulumState(built.dynamics->coordinates(), view(system), energies(system));
  s.at = instant();
  s.system = built.spec.name;
  s.energy_residual = energyResidual(system);
  return s;
}

state::DriveState Observer::drive(std::size_t drive) const {
  state::DriveState s = driveState(shaft(drive));
  s.at = instant();
  s.drive = twin_.scene().drives[drive].name;
  return s;
}

state::MotorState Observer::motor(std::size_t drive) const {
  const std::size_t system = twin_.turnedBy(drive);
  const DriveSpec& spec = twin_.scene().drives[drive];
  state::MotorState s = motorState(*spec.motor, motors_[drive], shaft(drive), energies(system));
  s.at = instant();
  s.drive = spec.name;
  s.system = twin_.systems()[system]->spec.name;
  return s;
}

}  // namespace whirl_twin

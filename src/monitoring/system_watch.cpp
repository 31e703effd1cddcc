#include "monitoring/system_watch.h"

#include <algorithm>
#include <memory>
#include <utility>

#include "scene/held_rotor.h"

namespace whirl_twin {
namespace {

constexpr double kMeanOver = 0.05;  // s, simulated: an acceleration made of speeds

constexpr double kShortBreak = 0.01;     // s, simulated
constexpr double kLongBreak = 0.05;      // s, simulated
constexpr double kFewCoordinates = 4.0;  // eigenvalues of more cost as the cube of their number

/// Low damping is a criterion for rotors; a pendulum may swing as long as it likes.
AlarmSettings settingsFor(const Dynamics& dynamics, AlarmSettings settings) {
  if (!dynamics.isRotor()) {
    settings.log_decrement_warning = 0.0;
    settings.decay_rate_alarm = 0.0;
  }
  return settings;
}

/// That a start-up multiplies.
bool hasLevels(const std::string& system, const AlarmSettings& settings) {
  return settings.trip_multiply > 1.0 && settings.amplitude.count(system) +
                                                 settings.zones.count(system) +
                                                 settings.voting.count(system) >
                                             0;
}

/// On a drive, or on a motor: either way what follows it has to know its angle.
bool hasShaft(const BuiltSystem& system) {
  return system.dynamics->hasShaft() ||
         (system.spec.drive.has_value() && rotorOnMotor(system).has_value());
}

}  // namespace

double newsBreak(const Dynamics& dynamics) {
  const double size = std::max(1.0, static_cast<double>(dynamics.dof()) / kFewCoordinates);
  const double cost = kShortBreak * size * size * size;
  return dynamics.linear() ? cost : std::max(kLongBreak, cost);
}

SystemWatch::SystemWatch(SharedSystem built, JudgedSpeeds first, const AlarmSettings& settings)
    : name(built->spec.name),
      speeds(std::move(first)),
      rotor(built->dynamics->isRotor()),
      dof(built->spec.q.size()),
      drive(built->spec.drive.value_or("")),
      speed(built->spec.speed.value_or(0.0)),
      quality(built->spec.name, settings),
      amplitude_alarm(built->spec.name, settings),
      voted_alarm(built->spec.name, settings),
      start_up(settings),
      has_levels(hasLevels(built->spec.name, settings)),
      order_alarm(built->spec.name, settings),
      decay_alarm(built->spec.name, settings),
      following_alarm(built->spec.name, hasShaft(*built), settings),
      critical_speed_alarm(built->spec.name, settings),
      capture_alarm(built->spec.name, settings),
      stability_alarm(built->spec.name, settingsFor(*built->dynamics, settings)),
      state_alarm(built->spec.name, settings),
      validity_alarm(built->spec.name, built->dynamics, settings),
      system(std::move(built)),
      news_break(newsBreak(*system->dynamics)) {
  if (rotor) {
    station = system->dynamics->stations().front();
  }
  const std::vector<CoordinateInfo> all = system->dynamics->coordinates();
  for (std::size_t k = 0; k < all.size(); ++k) {
    spin = all[k].name == "spin" ? static_cast<Eigen::Index>(k) : spin;
  }
}

std::vector<double> SystemWatch::coordinates(double x, double y, double turned) const {
  std::vector<double> all(dof, 0.0);
  for (std::size_t i = 0; i < dof; ++i) {
    const auto k = static_cast<Eigen::Index>(i);
    all[i] = k == spin ? turned
                       : x * station.along_x[k] / station.along_x.squaredNorm() +
                             y * station.along_y[k] / station.along_y.squaredNorm();
  }
  return all;
}

state::DriveState SystemWatch::shaftOf(const state::PendulumState& state) {
  state::DriveState shaft;
  shaft.at = state.at;
  shaft.speed = state.rate[static_cast<std::size_t>(spin)];
  if (!seen || shaft.at.time < seen->at.time) {
    seen = shaft;
  }
  const double since = shaft.at.time - seen->at.time;
  shaft.acceleration = seen->acceleration;
  if (since >= kMeanOver) {
    shaft.acceleration = (shaft.speed - seen->speed) / since;
    seen = shaft;
  }
  return shaft;
}

void SystemWatch::set(const AlarmSettings& settings) {
  quality.set(settings);
  if (measured) {
    measured->set(settings);
  }
  amplitude_alarm.set(settings);
  voted_alarm.set(settings);
  start_up.set(settings);
  has_levels = hasLevels(name, settings);
  order_alarm.set(settings);
  decay_alarm.set(settings);
  following_alarm.set(settings);
  critical_speed_alarm.set(settings);
  capture_alarm.set(settings);
  stability_alarm.set(settingsFor(*system->dynamics, settings));
  state_alarm.set(settings);
  validity_alarm.set(settings);
}

void SystemWatch::restart(const AlarmSettings& settings) {
  const std::shared_ptr<const Dynamics>& dynamics = system->dynamics;
  quality.restart();
  if (measured) {
    measured->restart();
  }
  vibration = {};
  amplitude_alarm = AmplitudeAlarm(name, settings);
  voted_alarm = VotedAlarm(name, settings);
  start_up = StartUp(settings);
  order_alarm = OrderAlarm(name, settings);
  decay_alarm = DecayAlarm(name, settings);
  following_alarm = FollowingAlarm(name, hasShaft(*system), settings);
  critical_speed_alarm = CriticalSpeedAlarm(name, settings);
  capture_alarm = CaptureAlarm(name, settings);
  seen.reset();
  stability_alarm = StabilityAlarm(name, settingsFor(*dynamics, settings));
  state_alarm = StateAlarm(name, settings);
  validity_alarm = ValidityAlarm(name, dynamics, settings);
  judged = false;
  last = {};
  news_at = -std::numeric_limits<double>::infinity();
}

void SystemWatch::holdMotion() {
  amplitude_alarm.hold();
  order_alarm.hold();
  decay_alarm.hold();
}

void SystemWatch::hold() {
  holdMotion();
  critical_speed_alarm.hold();
  capture_alarm.hold();
  stability_alarm.hold();
  state_alarm.holdEnergy();
  validity_alarm.hold();
}

}  // namespace whirl_twin

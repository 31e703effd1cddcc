#include "monitoring/system_monitor.h"

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

/// On a drive, or on a motor: either way an estimator has to know its angle.
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

SystemAlarms::SystemAlarms(const BuiltSystem& system, const SharedSettings& settings)
    : start_up(system.spec.name, settings),
      amplitude(system.spec.name, settings),
      voted(system.spec.name, settings),
      order(system.spec.name, settings),
      decay(system.spec.name, settings),
      estimator(system.spec.name, hasShaft(system), settings),
      critical_speed(system.spec.name, settings),
      capture(system.spec.name, settings),
      stability(system.spec.name, settings, system.dynamics->isRotor()),
      state(system.spec.name, settings),
      validity(system.spec.name, system.dynamics, settings) {}

void SystemAlarms::holdMotion() {
  amplitude.hold();
  order.hold();
  decay.hold();
}

void SystemAlarms::hold() {
  holdMotion();
  critical_speed.hold();
  capture.hold();
  stability.hold();
  state.holdEnergy();
  validity.hold();
}

SystemMonitor::SystemMonitor(SharedSystem built, CharacteristicSpeeds first,
                             const SharedSettings& settings)
    : name(built->spec.name),
      speeds(std::move(first)),
      rotor(built->dynamics->isRotor()),
      dof(built->spec.q.size()),
      drive(built->spec.drive.value_or("")),
      speed(built->spec.speed.value_or(0.0)),
      quality(name, *settings),
      alarms(*built, settings),
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

std::vector<double> SystemMonitor::coordinates(double x, double y, double turned) const {
  std::vector<double> all(dof, 0.0);
  for (std::size_t i = 0; i < dof; ++i) {
    const auto k = static_cast<Eigen::Index>(i);
    all[i] = k == spin ? turned
                       : x * station.along_x[k] / station.along_x.squaredNorm() +
                             y * station.along_y[k] / station.along_y.squaredNorm();
  }
  return all;
}

state::DriveState SystemMonitor::shaftOf(const state::PendulumState& state) {
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

void SystemMonitor::update(const AlarmSettings& settings) {
  quality.set(settings);
  if (measured) {
    measured->set(settings);
  }
  alarms.voted.update();
}

void SystemMonitor::restart(const SharedSettings& settings) {
  quality.restart();
  if (measured) {
    measured->restart();
  }
  vibration = {};
  alarms = SystemAlarms(*system, settings);
  seen.reset();
  evaluated = false;
  last = {};
  news_at = -kInfinity;
}

}  // namespace whirl_twin

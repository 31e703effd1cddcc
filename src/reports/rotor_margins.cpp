#include "reports/rotor_margins.h"

#include <algorithm>

#include "analysis/cross_coupling_margin.h"
#include "models/model_registry.h"
#include "scene/surroundings.h"

namespace whirl_twin {

namespace {

constexpr double kFastest = 1.0e6;  // [rad/s], that a motor without a limit is looked at

/// Where the motor's torque comes down to its drag: the whirl only slows it further. [rad/s]
double highestSpeed(const Motor& motor) {
  double speed = 1.0;
  for (std::size_t i = 0; i < motor.count; ++i) {
    speed = std::max(speed, motor.points[i].speed);
  }
  while (speed < kFastest && motor.torque(speed) > motor.drag * speed) {
    speed *= 2.0;
  }
  return std::min(speed, kFastest);
}

}  // namespace

std::optional<CrossCouplingMargin> crossCouplingMarginOf(const Dynamics& dynamics, double speed) {
  if (!dynamics.linear() || !dynamics.hasShaft() || dynamics.stations().empty() ||
      dynamics.dof() > kMostCoupledCoordinates) {
    return std::nullopt;
  }
  const std::vector<Station> stations = dynamics.stations();
  return CrossCouplingMargin{stations.front().name,
                             crossCouplingMargin(dynamics.linearRotor(), stations, 0, speed)};
}

std::vector<SteadySpeed> steadySpeedsOf(const Scene& scene, const SystemSpec& system) {
  Surroundings around = surroundingsOf(scene, system);
  if (!around.motor) {
    return {};
  }
  const Motor motor = *around.motor;
  around.motor.reset();
  const ModelSetup held =
      findModel(system.model)->setUp(system.parameters, system.settings, around);
  return held.dynamics->linear() && held.dynamics->hasShaft()
             ? sommerfeldSpeeds(held.dynamics->linearRotor(), motor, highestSpeed(motor))
             : std::vector<SteadySpeed>{};
}

}  // namespace whirl_twin

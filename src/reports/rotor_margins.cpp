#include "reports/rotor_margins.h"

#include "analysis/cross_coupling_margin.h"
#include "scene/held_rotor.h"

namespace whirl_twin {

std::optional<CrossCouplingMargin> crossCouplingMarginOf(const Dynamics& dynamics, double speed) {
  if (!dynamics.linear() || !dynamics.hasShaft() || dynamics.stations().empty() ||
      dynamics.dof() > kMostCoupledCoordinates) {
    return std::nullopt;
  }
  const std::vector<Station> stations = dynamics.stations();
  return CrossCouplingMargin{stations.front().name,
                             crossCouplingMargin(dynamics.linearRotor(), stations, 0, speed)};
}

std::vector<SteadySpeed> steadySpeedsOf(const BuiltSystem& system) {
  const std::optional<RotorOnMotor> driven = rotorOnMotor(system);
  return driven && driven->held->linear() && driven->held->hasShaft()
             ? sommerfeldSpeeds(driven->held->linearRotor(), driven->motor,
                                highestSpeed(driven->motor))
             : std::vector<SteadySpeed>{};
}

}  // namespace whirl_twin

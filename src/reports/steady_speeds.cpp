#include "reports/steady_speeds.h"

#include <optional>

#include "scene/held_rotor.h"

namespace whirl_twin {

std::vector<SteadySpeed> steadySpeedsOf(const BuiltSystem& system) {
  const std::optional<RotorOnMotor> driven = rotorOnMotor(system);
  return driven && driven->held->linear() && driven->held->hasShaft()
             ? sommerfeldSpeeds(driven->held->linearRotor(), driven->motor,
                                highestSpeed(driven->motor))
             : std::vector<SteadySpeed>{};
}

}  // namespace whirl_twin

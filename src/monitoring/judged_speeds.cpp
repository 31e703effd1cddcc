#include "monitoring/judged_speeds.h"

#include "analysis/separation_margin.h"
#include "scene/held_rotor.h"

namespace whirl_twin {

JudgedSpeeds JudgedSpeeds::of(const BuiltSystem& system) {
  JudgedSpeeds speeds;
  const DataSpeeds tables = tableSpeeds(system);
  for (const CriticalSpeed& c : criticalSpeeds(*heldDynamics(system))) {
    if (tables.covers(c.speed)) {
      speeds.critical.push_back(c);
    }
  }
  speeds.captures = captureSpeeds(system, speeds.marginsAt(0.0));
  return speeds;
}

std::vector<state::CriticalSpeedMargin> JudgedSpeeds::marginsAt(double speed) const {
  std::vector<state::CriticalSpeedMargin> margins;
  for (const CriticalSpeed& c : critical) {
    margins.push_back(criticalSpeedMargin(speed, c.speed, c.forward ? "forward" : "backward",
                                          c.amplification_factor));
  }
  return margins;
}

}  // namespace whirl_twin

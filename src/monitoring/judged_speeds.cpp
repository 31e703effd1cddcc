#include "monitoring/judged_speeds.h"

#include "monitoring/separation_margin.h"

namespace whirl_twin {

std::vector<state::CriticalSpeedMargin> JudgedSpeeds::marginsAt(double speed) const {
  std::vector<state::CriticalSpeedMargin> margins;
  for (const CriticalSpeed& c : critical) {
    margins.push_back(criticalSpeedMargin(speed, c.speed, c.forward ? "forward" : "backward",
                                          c.amplification_factor));
  }
  return margins;
}

}  // namespace whirl_twin

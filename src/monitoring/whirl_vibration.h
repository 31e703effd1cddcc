// The vibration of a rotor over a revolution, which alarms go by (API 670): not the radius of an
// instant, which an elliptical orbit takes above and below a level twice a turn, and in which sag
// counts as vibration.
#pragma once

#include <cstdint>

#include "messages/states.h"
#include "signal/orbit_window.h"

namespace whirl_twin {

class WhirlVibration {
 public:
  /// Takes the next state; its amplitude then. [m]: the largest distance from the middle of the
  /// orbit during the last revolution (OrbitWindow::amplitude), or during the last second where the
  /// shaft turns slower than once a second or its speed has just doubled or halved. NaN until there
  /// is as much.
  double take(const state::WhirlState& whirl);

 private:
  OrbitWindow window_;
  std::int64_t taken_ = 0;
  double since_ = 0.0;  // [s], of the first state without a step back in time
};

}  // namespace whirl_twin

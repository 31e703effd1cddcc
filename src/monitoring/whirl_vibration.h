// The vibration of a rotor over a revolution, which alarms go by (API 670): not the radius of an
// instant, which an elliptical orbit takes above and below a level twice a turn, and in which sag
// counts as vibration.
#pragma once

#include <cstddef>
#include <cstdint>

#include "algebra/constants.h"
#include "messages/states.h"
#include "signal/orbit_window.h"

namespace whirl_twin {

class WhirlVibration {
 public:
  /// Takes the next state; its amplitude then. [m]: the largest distance from the middle of the
  /// orbit during the last revolution (OrbitWindow::amplitude), or during the last second where the
  /// shaft turns slower than once a second or its speed has just doubled or halved. NaN until there
  /// is as much.
  double take(const state::WhirlState& whirl) {
    if (window_.empty() || whirl.at.time < window_.newest().time) {
      since_ = whirl.at.time;
    }
    window_.take({++taken_, whirl.at.time, 0, whirl.shaft_angle, whirl.speed, whirl.x, whirl.y});
    const double revolution = window_.since(1.0);
    if (revolution > 0.0 && revolution < kMaxRevolution) {
      return window_.amplitude(revolution, kMinOfOrbit);
    }
    return whirl.at.time - since_ < kMaxRevolution ? kNaN
                                                   : window_.amplitude(kMaxRevolution, kMinOfOrbit);
  }

 private:
  static constexpr double kMaxRevolution = 1.0;  // [s]
  static constexpr std::size_t kMinOfOrbit =
      32;  // samples, of several revolutions where they are rare

  OrbitWindow window_;
  std::int64_t taken_ = 0;
  double since_ = 0.0;  // [s], of the first state without a step back in time
};

}  // namespace whirl_twin

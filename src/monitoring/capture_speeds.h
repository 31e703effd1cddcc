// Where a rotor on its motor would be captured (Sommerfeld's effect): the steady speed below or in
// a critical band that only the whirl holds it at. But for the resonance the motor would take it on
// beyond the band. By the quasi-static balance of torques (sommerfeld_speeds.h): a motor with much
// of its power in the run-up itself may pass where that foretells a capture.
#pragma once

#include <vector>

#include "analysis/separation_margin.h"
#include "scene/built_system.h"

namespace whirl_twin {

struct CaptureSpeed {
  double speed = 0.0;           ///< [rad/s], where it hangs
  double escape = 0.0;          ///< [rad/s], from which on it would pass by itself
  double critical_speed = 0.0;  ///< [rad/s], that holds it
  SpeedBand band;               ///< of that critical speed [rad/s]
};

/// Ascending; none where its motor passes every critical speed, and for a system without a motor.
/// critical_speeds: those of the rotor with its shaft held, with their bands.
std::vector<CaptureSpeed> captureSpeeds(
    const BuiltSystem& system, const std::vector<state::CriticalSpeedMargin>& critical_speeds);

}  // namespace whirl_twin

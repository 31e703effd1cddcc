// Checks in advance whether a motor under a speed controller has enough torque: in each band that
// it must cross, compares the torque that the whirl absorbs at a steady speed (sommerfeld_speeds.h)
// with the available torque.
//
// With less torque than that the passage may still succeed: a rotor that accelerates through a
// resonance whirls with a smaller amplitude than at a steady speed. The passage is therefore
// simulated with the rotor's equations and the control law, from the run-up before the band, with
// as many attempts as the controller makes. Sensors, delay and rate are neglected.
#pragma once

#include <string>
#include <vector>

#include "scene/controller_spec.h"
#include "scene/scene.h"

namespace whirl_twin {

/// For a controller of type `speed` that has been read, and a rotor with linear whirl. The bands
/// from the initial speed of the shaft on, up to the first that it does not pass.
std::vector<ResonancePassageCheck> resonancePassageChecks(const Scene& scene,
                                                          const ControllerSpec& controller);

/// The bands that a controller avoids, given and about critical speeds; none unless it controls the
/// speed of a shaft.
std::vector<SpeedBand> avoidedBands(const Scene& scene, const ControllerSpec& controller);

/// "from 180 to 220 rad/s: at 199.5 rad/s a steady whirl takes 0.4006 N m, and there are 0.3".
std::string describe(const ResonancePassageCheck& passage);

}  // namespace whirl_twin

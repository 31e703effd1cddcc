// What a motor under a speed controller lacks, known before it is tried: in each band that it is to
// bring its rotor through, the torque that the whirl takes at a steady speed (sommerfeld_speeds.h)
// beside what there is.
//
// Too little is not yet too little to pass: a rotor that is thrown through a resonance whirls less
// than one that stays. So the passage is rehearsed, by the rotor's own equations and the
// controller's own law, from the run-up before the band, as often as the controller tries. Sensors,
// delay and rate are left out of that.
#pragma once

#include <string>
#include <vector>

#include "scene/controller_spec.h"
#include "scene/scene.h"

namespace whirl_twin {

/// Of a controller of type `speed` that has been read, of rotors whose whirl is linear. The bands
/// on its way from where its shaft starts, up to the first that it does not pass.
std::vector<WeakPassage> weakPassages(const Scene& scene, const ControllerSpec& controller);

/// What a controller avoids, given and about critical speeds; none, of one that brings no shaft to
/// a speed.
std::vector<SpeedBand> avoidedBands(const Scene& scene, const ControllerSpec& controller);

/// "from 180 to 220 rad/s: at 199.5 rad/s a steady whirl takes 0.4006 N m, and there are 0.3".
std::string describe(const WeakPassage& passage);

}  // namespace whirl_twin

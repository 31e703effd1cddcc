// Reads the controllers of a scene.
//
//   controllers:
//     levitation:
//       type: pid
//       rate: 20000.0                     # Hz, in any ratio to the step
//       measures: [rotor.x, {signal: rotor.node_3, direction: 0.785}]
//       acts_on: [rotor.force_x, rotor.force_y]
//       delay: 8.0e-5                     # s, from a sample to its output
//       sensor: {resolution: 1.0e-7, noise: 2.0e-7, range: 4.0e-4}
//       actuator: {limit: 5.0, slew: 2.0e4, resolution: 2.4e-3}
//       parameters: {kp: 2.0e4, kd: 30.0}
#pragma once

#include "scene/node_reader.h"
#include "scene/scene.h"

namespace whirl_twin {

/// Reads the controllers under `key` into a scene whose drives and systems have been read; the
/// inputs they act on become controlled inputs of their systems. Adds a diagnostic for every error.
void readControllers(const YAML::Node& node, const std::string& key, Scene& scene,
                     Diagnostics& diagnostics);

/// The context of a controller of a scene, from which its control law is made.
ControllerPlan planOf(const Scene& scene, const ControllerSpec& controller);

}  // namespace whirl_twin

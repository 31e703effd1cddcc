// Reads what a follower is told beside its scene, a YAML map:
//
//   systems:
//     pendulum:
//       disturbance: 0.05                       # rad/s^2/sqrt(Hz), of each coordinate
//       parameters:
//         damping1: 0.5                         # what may be wrong with it, in parts of its value
//         coulomb1: {deviation: 0.5, walk: 1e-3}  # and what it changes by, in a second
//       inputs:                                 # what acts on them, where it is measured
//         torque1: motors/tau1                  # SOURCE/CHANNEL
//         torque2: {channel: motors/tau2, scale: 0.9, offset: 0.01, deviation: 0.02, hold: true}
//       offsets: {encoders/theta1: 0.01}        # rad, what zeros may be off by; or {encoders:
//                                               # {theta1: 0.01}}, as on a parameter server
//     rotor:
//       unbalance: {deviation: 1e-4, walk: 0.0}   # kg m, beside the scene's, at each station
//       run_out: 5e-6                           # m, under each displacement probe
//   false_alarms: 0.02                          # an hour
//   patience: 0.25                              # s, that samples wait for slower sources; else
//                                               # 0.25 s and the longest block of the sensors
#pragma once

#include <yaml-cpp/yaml.h>

#include <string>

#include "estimation/follow_settings.h"
#include "scene/built_scene.h"

namespace whirl_twin {

/// Of the systems, parameters and channels of the scene. Throws Refusal with every complaint, each
/// with `source` and key before it.
FollowSettings readFollowSettings(const YAML::Node& tree, const std::string& source,
                                  const BuiltScene& scene);

}  // namespace whirl_twin

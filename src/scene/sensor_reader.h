// Reads the sensors of a scene.
//
//   sensors:
//     probes:
//       rate: 2000.0                   # Hz
//       channels:
//         x: {measures: rotor.x, noise: 3.0e-6, resolution: 1.0e-7, range: 1.0e-3,
//             bandwidth: 500.0, delay: 1.0e-4, run_out: 1.0e-5, run_out_angle: 0.4}
//         v: {measures: rotor.node_3, direction: 0.785}
//     tacho: {keyphasor: shaft, jitter: 1.0e-6, resolution: 1.0e-7}
#pragma once

#include <string>
#include <vector>

#include "scene/node_reader.h"
#include "scene/scene.h"
#include "scene/sensor_spec.h"

namespace whirl_twin {

/// Reads the sensors under `key`, of a scene whose drives and systems have been read. Adds a
/// diagnostic for every error.
std::vector<SensorSpec> readSensors(const YAML::Node& node, const std::string& key,
                                    const Scene& scene, Diagnostics& diagnostics);

}  // namespace whirl_twin

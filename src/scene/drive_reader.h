// Reads a drive of a scene: initial speed and angle, and the moves of its profile or the
// characteristic of its motor. `avoid` is read after the systems (avoidance_reader.h).
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "scene/node_reader.h"
#include "scene/scene.h"

namespace whirl_twin {

// Durations of the moves of a drive.

/// Duration [s] of the change of speed of each move of a drive's profile, without the dwell.
std::vector<double> changeDurations(const DriveSpec& drive);

/// Duration [s] of the whole profile, dwells included; 0 for a drive without one.
double profileDuration(const DriveSpec& drive);

/// Reads the drive `name` under `key`; start [ns] is the scene's. Adds a diagnostic for every
/// error.
DriveSpec readDrive(const YAML::Node& node, const std::string& key, const std::string& name,
                    std::int64_t start, Diagnostics& diagnostics);

}  // namespace whirl_twin

// Reads a drive of a scene: its speed and angle at the start, and the moves of its profile
// or the law of its motor. What it avoids is read when the systems have been (avoidance_reader.h).
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "scene/node_reader.h"
#include "scene/scene.h"

namespace whirl_twin {

// How long the moves of a drive last.

/// Duration [s] of the change of speed of each move of a drive's profile, without the dwell.
std::vector<double> changeDurations(const DriveSpec& drive);

/// Duration [s] of the whole profile, dwells included; 0 for a drive without one.
double profileDuration(const DriveSpec& drive);

/// The drive `name` under `key`; start [ns] is the scene's. Complains of everything that does not
/// fit.
DriveSpec readDrive(const YAML::Node& node, const std::string& key, const std::string& name,
                    std::int64_t start, Complaints& complaints);

}  // namespace whirl_twin

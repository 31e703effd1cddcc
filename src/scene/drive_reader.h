// Reads a drive of a scene: its speed and angle at the start, and the moves of its profile
// or the law of its motor. What it avoids is read when the systems have been (avoidance_reader.h).
#pragma once

#include <cstdint>
#include <string>

#include "scene/node_reader.h"
#include "scene/scene.h"

namespace whirl_twin {

/// The drive `name` under `key`; start [ns] is the scene's. Complains of everything that does not
/// fit.
DriveSpec readDrive(const YAML::Node& node, const std::string& key, const std::string& name,
                    std::int64_t start, Complaints& complaints);

}  // namespace whirl_twin

// Reads which speeds a drive of a scene passes and does not stay at: bands as given, and those
// about the critical speeds of the systems that it turns, found here once, by what the monitor and
// `twin analyze` find them by.
#pragma once

#include <cstddef>
#include <string>

#include "scene/node_reader.h"
#include "scene/scene.h"

namespace whirl_twin {

/// The `avoid` of a drive under `key`, into Scene::drives[drive], of a scene whose systems have
/// been read. Complains of a drive that is to start or to stay in a band.
void readAvoidance(const YAML::Node& node, const std::string& key, std::size_t drive, Scene& scene,
                   Complaints& complaints);

}  // namespace whirl_twin

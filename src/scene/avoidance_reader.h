// Reads which speeds a drive of a scene passes and does not stay at: bands as given, and those
// about the critical speeds of the systems that it turns, found here once, by what the monitor and
// `twin analyze` find them by.
#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <vector>

#include "control/exclusion_bands.h"
#include "scene/node_reader.h"
#include "scene/scene.h"

namespace whirl_twin {

// [-], of a critical speed, that its band may reach on both sides.
inline constexpr double kLeastBandMargin = 1.0e-3;
inline constexpr double kMostBandMargin = 0.9;

/// About the critical speeds of what a drive turns: margin [-] of them on both sides; without one
/// the separation that the monitor asks for. Complains under `key` where they cannot be found.
std::vector<SpeedBand> criticalBands(const Scene& scene, std::size_t drive,
                                     std::optional<double> margin, const std::string& key,
                                     Complaints& complaints);

/// The `avoid` of a drive under `key`, into Scene::drives[drive], of a scene whose systems have
/// been read. Complains of a drive that is to start or to stay in a band.
void readAvoidance(const YAML::Node& node, const std::string& key, std::size_t drive, Scene& scene,
                   Complaints& complaints);

}  // namespace whirl_twin

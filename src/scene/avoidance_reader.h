// Reads the barred speed ranges of a drive: given bands, and those about the critical speeds of its
// systems, computed once here with the functions that the monitor and `twin analyze` use.
#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <vector>

#include "control/exclusion_bands.h"
#include "scene/node_reader.h"
#include "scene/scene.h"

namespace whirl_twin {

// [-], half width of a band about a critical speed, relative to it.
inline constexpr double kMinBandMargin = 1.0e-3;
inline constexpr double kMaxBandMargin = 0.9;

/// Bands about the critical speeds of the systems of a drive: half width `margin` [-] relative to
/// the critical speed; without it, the separation margin that the monitor requires. Adds a
/// diagnostic under `key` if they cannot be computed.
std::vector<SpeedBand> criticalBands(const Scene& scene, std::size_t drive,
                                     std::optional<double> margin, const std::string& key,
                                     Diagnostics& diagnostics);

/// Reads `avoid` of each of the scene's drives into Scene::drives, after its systems. Adds a
/// diagnostic for a drive with an initial or target speed inside a band.
void readAvoidedSpeeds(const MapReader& scene_map, Scene& scene, Diagnostics& diagnostics);

}  // namespace whirl_twin

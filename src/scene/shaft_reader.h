// Reads the shaft speed of a system: a drive of the scene, or a constant speed.
#pragma once

#include <cstddef>
#include <string>
#include <unordered_map>

#include "models/model_info.h"
#include "scene/node_reader.h"
#include "scene/scene.h"

namespace whirl_twin {

/// Indices of the drives in a scene, by name.
using DrivePlaces = std::unordered_map<std::string, std::size_t>;

/// Fills spec.drive and its index; adds a diagnostic if model, drive and speed are inconsistent.
void readShaft(const MapReader& system, const ModelInfo& model, const Scene& scene,
               const DrivePlaces& places, SystemSpec& spec, Diagnostics& diagnostics);

/// The initial spin of a system on a motor is that of its drive: fills the last of spec.q and
/// spec.v.
void startSpin(const MapReader& initial, const Scene& scene, SystemSpec& spec,
               Diagnostics& diagnostics);

/// A motor's shaft is a state of one system: adds a diagnostic unless exactly one names it.
void checkMotors(const Scene& scene, Diagnostics& diagnostics);

}  // namespace whirl_twin

// Reads what turns a system's shaft: a drive of the scene, or a constant speed of its own.
#pragma once

#include <cstddef>
#include <string>
#include <unordered_map>

#include "models/model_info.h"
#include "scene/node_reader.h"
#include "scene/scene.h"

namespace whirl_twin {

/// The places of the drives in a scene, by name.
using DrivePlaces = std::unordered_map<std::string, std::size_t>;

/// Fills spec.drive and its place; complains where the model, the drive and the speed do not go
/// together.
void readShaft(const MapReader& system, const ModelInfo& model, const Scene& scene,
               const DrivePlaces& places, SystemSpec& spec, Complaints& complaints);

/// A spin that a motor turns starts as its drive does: fills the last of spec.q and spec.v.
void startSpin(const MapReader& initial, const Scene& scene, SystemSpec& spec,
               Complaints& complaints);

/// A motor's shaft is a state of one system: complains of any other number.
void checkMotors(const Scene& scene, Complaints& complaints);

}  // namespace whirl_twin

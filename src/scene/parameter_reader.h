// Reads a system's `parameters` as its model wants them: numbers with units and ranges, words,
// matrices, names and tables.
#pragma once

#include "models/model_info.h"
#include "scene/node_reader.h"
#include "scene/scene.h"

namespace whirl_twin {

/// Fills spec.parameters, spec.settings and spec.speed; complains of everything that does not fit.
void readParameters(const MapReader& system, const ModelInfo& model, SystemSpec& spec,
                    Complaints& complaints);

}  // namespace whirl_twin

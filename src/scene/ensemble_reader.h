// Reads a system's `count`, `seed` and `spread`: its ensemble, or, without a count, the uncertainty
// of its numbers.
#pragma once

#include "models/model_info.h"
#include "scene/node_reader.h"
#include "scene/scene.h"

namespace whirl_twin {

/// Fills spec.ensemble, after the other parameters and initial values have been read; adds a
/// diagnostic for every error.
void readEnsemble(const MapReader& system, const ModelInfo& model,
                  const std::vector<CoordinateInfo>& coordinates, SystemSpec& spec,
                  Diagnostics& diagnostics);

}  // namespace whirl_twin

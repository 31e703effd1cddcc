// Reads a system's `count`, `seed` and `spread`: the ensemble it stands for, or, without
// a count, how well its numbers are known.
#pragma once

#include "models/model_info.h"
#include "scene/node_reader.h"
#include "scene/scene.h"

namespace whirl_twin {

/// Fills spec.ensemble, whose other parameters and initial values have been read; complains of
/// everything that does not fit.
void readEnsemble(const MapReader& system, const ModelInfo& model,
                  const std::vector<CoordinateInfo>& coordinates, SystemSpec& spec,
                  Complaints& complaints);

}  // namespace whirl_twin

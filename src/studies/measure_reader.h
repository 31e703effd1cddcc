// Reads the measures and requirements of a study.
#pragma once

#include "scene/built_scene.h"
#include "scene/node_reader.h"
#include "studies/study.h"

namespace whirl_twin {

/// Reads `measure` and `require` into a study whose scene, run and variations have been read; adds
/// errors to the diagnostics.
void readMeasures(const MapReader& map, const BuiltScene& scene, Study& study,
                  Diagnostics& diagnostics);

}  // namespace whirl_twin

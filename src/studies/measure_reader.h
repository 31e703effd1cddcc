// Reads what a study measures of each point, and what it requires of that.
#pragma once

#include "scene/built_scene.h"
#include "scene/node_reader.h"
#include "studies/study.h"

namespace whirl_twin {

/// `measure` and `require` of a study whose scene, run and variations have been read, into it; what
/// is wrong is complained of.
void readMeasures(const MapReader& map, const BuiltScene& scene, Study& study,
                  Complaints& complaints);

}  // namespace whirl_twin

// Reads what a study looks for the least or the most of.
#pragma once

#include "scene/node_reader.h"
#include "studies/study.h"

namespace whirl_twin {

/// `optimize` of a study whose variations, measures and requirements have been read, into it; what
/// is wrong is complained of.
void readOptimization(const MapReader& map, Study& study, Complaints& complaints);

}  // namespace whirl_twin

// Reads the design of a study.
#pragma once

#include <vector>

#include "scene/node_reader.h"
#include "studies/study.h"

namespace whirl_twin {

/// Reads `design` of a study with these varied numbers; adds errors to the diagnostics.
Design readDesign(const MapReader& study, const std::vector<Variation>& vary,
                  Diagnostics& diagnostics);

}  // namespace whirl_twin

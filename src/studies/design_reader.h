// Reads the design of a study.
#pragma once

#include <vector>

#include "scene/node_reader.h"
#include "studies/study.h"

namespace whirl_twin {

/// `design` of a study, of the numbers that vary; what is wrong is complained of.
Design readDesign(const MapReader& study, const std::vector<Variation>& vary,
                  Complaints& complaints);

}  // namespace whirl_twin

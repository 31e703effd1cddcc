// Reads which numbers of a scene vary in a study, and how.
#pragma once

#include <map>
#include <string>
#include <vector>

#include "scene/node_reader.h"
#include "scene/scene.h"
#include "studies/scene_numbers.h"
#include "studies/study.h"

namespace whirl_twin {

/// `vary` of a study, of the numbers that its scene has; what is wrong is complained of.
std::vector<Variation> readVariations(const MapReader& study, const Scene& scene,
                                      const std::map<std::string, NamedNumber>& numbers,
                                      Complaints& complaints);

}  // namespace whirl_twin

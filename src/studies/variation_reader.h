// Reads the varied numbers of a study and their distributions.
#pragma once

#include <map>
#include <string>
#include <vector>

#include "scene/node_reader.h"
#include "scene/scene.h"
#include "studies/scene_numbers.h"
#include "studies/study.h"

namespace whirl_twin {

/// Reads `vary` of a study, for the numbers of its scene; adds errors to the diagnostics.
std::vector<Variation> readVariations(const MapReader& study, const Scene& scene,
                                      const std::map<std::string, NamedNumber>& numbers,
                                      Diagnostics& diagnostics);

}  // namespace whirl_twin

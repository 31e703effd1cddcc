// How the members of an ensemble are stepped: side by side in vectors where their equations allow
// it, else one by one.
#pragma once

#include <cstddef>
#include <memory>
#include <string>
#include <vector>

#include "models/model_info.h"
#include "scene/scene.h"
#include "twin/ensemble.h"

namespace whirl_twin {

struct EnsembleMember {
  SystemSpec spec;
  ModelSetup setup;
};

constexpr std::size_t kMostSampled = 8;  ///< members, whose errors are measured

/// These, evenly spread over so many.
std::vector<std::size_t> sampledMembers(std::size_t count);

/// Of at least one member, with the scene's step [s]. The excitation outlives it.
std::unique_ptr<EnsembleSteps> ensembleSteps(const std::vector<EnsembleMember>& members,
                                             const std::string& integrator,
                                             const Excitation& excitation, double step);

}  // namespace whirl_twin

// How the members of an ensemble are stepped: side by side in vectors where their equations allow
// it, else one by one.
#pragma once

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

/// Of at least one member, with the scene's step [s]. The excitation outlives it.
std::unique_ptr<EnsembleSteps> ensembleSteps(const std::vector<EnsembleMember>& members,
                                             const std::string& integrator,
                                             const Excitation& excitation, double step);

}  // namespace whirl_twin

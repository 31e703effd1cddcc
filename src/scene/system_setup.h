// The model of a system set up, and what it was set up from.
//
// To set a model up may take long (a flexible rotor is assembled and reduced), so it is done once:
// readScene() leaves the result in the spec, and whoever builds the system takes it from there. A
// spec that was changed since, as tests and tools do, still builds what it says: the setup is
// compared with everything a setup depends on, and made anew where that differs.
#pragma once

#include <memory>

#include "models/model_info.h"
#include "scene/scene.h"

namespace whirl_twin {

struct SystemSetup {
  // From
  const ModelInfo* model = nullptr;
  ParameterValues parameters;
  Settings settings;
  Surroundings around{0.0};
  // came
  ModelSetup made;
};

/// Runs the model's setUp. Throws what that throws: SetupError, or other exceptions for numbers
/// that no arithmetic can do with.
std::shared_ptr<const SystemSetup> setUp(const ModelInfo& model, const SystemSpec& spec,
                                         const Surroundings& around);

/// The setup that the spec carries if that is of what it says now; else a new one, which it
/// carries from now on. Throws std::logic_error where there is no such model, and as setUp().
const SystemSetup& setupOf(SystemSpec& spec, const Surroundings& around);

}  // namespace whirl_twin

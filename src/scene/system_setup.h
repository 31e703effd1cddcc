// The set-up model of a system, with the values it was set up from.
//
// Setting up a model may take long (a flexible rotor is assembled and reduced), so it is done once:
// readScene() stores the result in the spec, from which the system is built. A spec that was
// changed since, as by tests and tools, is still built correctly: the stored values are compared
// with everything a setup depends on, and the setup is repeated if they differ.
#pragma once

#include <memory>

#include "models/model_info.h"
#include "scene/scene.h"

namespace whirl_twin {

struct SystemSetup {
  // Inputs of setUp
  const ModelInfo* model = nullptr;
  ParameterValues parameters;
  Settings settings;
  ModelContext around{0.0};
  // and its result.
  ModelSetup made;
};

/// Runs the model's setUp. Throws what that throws: SetupError, or other exceptions for numerically
/// unusable values.
std::shared_ptr<const SystemSetup> setUp(const ModelInfo& model, const SystemSpec& spec,
                                         const ModelContext& around);

/// The setup stored in the spec if it is up to date; else a new one, which is stored. Throws
/// std::logic_error for an unknown model, and as setUp().
const SystemSetup& setupOf(SystemSpec& spec, const ModelContext& around);

}  // namespace whirl_twin

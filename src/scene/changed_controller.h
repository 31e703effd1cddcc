// Changes the parameters of a controller of a scene while the twin runs.
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "controllers/controller.h"
#include "messages/states.h"
#include "scene/scene.h"

namespace whirl_twin {

/// A controller specification and its control law.
struct ChangedController {
  ControllerSpec spec;
  std::unique_ptr<Controller> law;  ///< in its initial state
};

/// The control law of a controller, in its initial state.
std::unique_ptr<Controller> lawOf(const Scene& scene, const ControllerSpec& controller);

/// Whether it has numbers that can be changed; those of a controller in another process are there.
bool hasParameters(const ControllerSpec& controller);

/// All numbers with their values; `changed` is empty.
state::ParameterChange parametersOf(const ControllerSpec& controller);

/// The controller with other numbers at these paths (parameter_paths.h); the scene has its plant.
/// Throws InputError with the diagnostics of a scene, each with `source` and the key
/// controllers.NAME.parameters…, for unknown paths, values out of range and inconsistent
/// parameters.
ChangedController withParameters(const Scene& scene, const ControllerSpec& controller,
                                 const std::vector<std::string>& paths,
                                 const std::vector<double>& values, const std::string& source);

}  // namespace whirl_twin

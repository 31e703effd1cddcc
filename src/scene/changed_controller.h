// A controller of a scene with other numbers, while the twin runs.
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "controllers/controller.h"
#include "messages/states.h"
#include "scene/scene.h"

namespace whirl_twin {

/// What a controller is said to be, and the law that this makes.
struct ChangedController {
  ControllerSpec spec;
  std::unique_ptr<Controller> law;  ///< at its beginning
};

/// The law of a controller, at its beginning.
std::unique_ptr<Controller> lawOf(const Scene& scene, const ControllerSpec& controller);

/// Has it numbers that can be changed? Those of one in another process are of that process.
bool hasParameters(const ControllerSpec& controller);

/// All numbers with their values; nothing `changed`.
state::ParameterChange parametersOf(const ControllerSpec& controller);

/// With other numbers at these paths (parameter_paths.h); the scene says what is around it. Throws
/// Refusal in the words of a scene, each complaint with the key controllers.NAME.parameters… and
/// `source` before it, for paths that it does not have, values out of range and parameters that do
/// not fit together.
ChangedController withParameters(const Scene& scene, const ControllerSpec& controller,
                                 const std::vector<std::string>& paths,
                                 const std::vector<double>& values, const std::string& source);

}  // namespace whirl_twin

#include "scene/changed_controller.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "controllers/controller_registry.h"
#include "messages/input_error.h"
#include "scene/controller_reader.h"
#include "scene/error_list.h"
#include "scene/node_reader.h"
#include "scene/parameter_paths.h"

namespace whirl_twin {

std::unique_ptr<Controller> lawOf(const Scene& scene, const ControllerSpec& controller) {
  return findController(controller.type)
      ->make(controller.parameters, controller.settings, planOf(scene, controller));
}

bool hasParameters(const ControllerSpec& controller) {
  return controller.type != "external";
}

state::ParameterChange parametersOf(const ControllerSpec& controller) {
  return parametersOf(*findController(controller.type), controller);
}

ChangedController withParameters(const Scene& scene, const ControllerSpec& controller,
                                 const std::vector<std::string>& paths,
                                 const std::vector<double>& values, const std::string& source) {
  Diagnostics diagnostics(source);
  const std::string key = fmt::format("controllers.{}.parameters", controller.name);
  ChangedController changed{controller, nullptr};
  if (!hasParameters(controller)) {
    diagnostics.add(key, "must be changed in the controller's own process");
  } else {
    for (std::size_t i = 0; i < paths.size(); ++i) {
      setParameter(paths[i], values[i], *findController(controller.type), changed.spec,
                   diagnostics);
    }
  }
  if (diagnostics.all().empty()) {
    try {
      changed.law = lawOf(scene, changed.spec);
    } catch (const SetupError& error) {
      diagnostics.add(key + "." + error.parameter(), error.what());
    } catch (const std::exception& error) {  // numerically unusable values
      diagnostics.add(key, error.what());
    }
  }
  if (!diagnostics.all().empty()) {
    throw InputError(errorList(diagnostics.all()));
  }
  return changed;
}

}  // namespace whirl_twin

#include "scene/changed_controller.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "controllers/controller_registry.h"
#include "messages/refusal.h"
#include "scene/controller_reader.h"
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
  Complaints complaints(source);
  const std::string key = fmt::format("controllers.{}.parameters", controller.name);
  ChangedController changed{controller, nullptr};
  if (!hasParameters(controller)) {
    complaints.add(key, "must be changed in the controller's own process");
  } else {
    for (std::size_t i = 0; i < paths.size(); ++i) {
      setParameter(paths[i], values[i], *findController(controller.type), changed.spec, complaints);
    }
  }
  if (complaints.all().empty()) {
    try {
      changed.law = lawOf(scene, changed.spec);
    } catch (const SetupError& error) {
      complaints.add(key + "." + error.parameter(), error.what());
    } catch (const std::exception& error) {  // of numbers that no arithmetic can do with
      complaints.add(key, error.what());
    }
  }
  if (!complaints.all().empty()) {
    throw Refusal(fmt::format("{}", fmt::join(complaints.all(), "\n")));
  }
  return changed;
}

}  // namespace whirl_twin

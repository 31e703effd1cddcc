#include "twin/stop_text.h"

#include <fmt/format.h>

#include <algorithm>
#include <vector>

namespace whirl_twin {

const char* describe(StepStatus status) {
  switch (status) {
    case StepStatus::kNotFinite:
      return "state not finite";
    case StepStatus::kNotConverged:
      return "implicit step did not converge";
    case StepStatus::kOutOfRange:
      return "the speed of its shaft is outside the prepared range";
    case StepStatus::kNoGap:
      return "its shaft touches a bearing: the air gap or oil film is 0";
    case StepStatus::kControllerLost:
      return "its controller no longer answers";
    case StepStatus::kOk:
      break;
  }
  return "";
}

std::string describeLost(const ControllerSpec& controller, std::size_t system) {
  const auto is_it = [&](const ActedInput& acted) { return acted.system == system; };
  if (controller.type != "external" || controller.settings.choices.at("on_timeout") != "stop" ||
      std::none_of(controller.acts_on.begin(), controller.acts_on.end(), is_it)) {
    return "";
  }
  return fmt::format("controller {} has not answered for {:g} s of {} time (on_timeout: stop)",
                     controller.name, controller.parameters.at("timeout"),
                     controller.settings.choices.at("mode") == "lockstep" ? "wall" : "simulated");
}

std::string stopText(const BuiltSystem& system, const SystemView& view, const std::string& why,
                     std::int64_t step, double time) {
  const std::vector<CoordinateInfo> coordinates = system.dynamics->coordinates();
  std::string values;
  for (std::size_t i = 0; i < view.dof(); ++i) {
    const CoordinateInfo& c = coordinates[i];
    values += fmt::format("{}{} = {:.6g} {}, {}_rate = {:.6g} {}/s", i == 0 ? "" : ", ", c.name,
                          view.q()[i], c.unit, c.name, view.v()[i], c.unit);
  }
  return fmt::format("{}: stopped in step {} (t = {:.9g} s), {}; last valid state: {}",
                     system.spec.name, step, time, why, values);
}

}  // namespace whirl_twin

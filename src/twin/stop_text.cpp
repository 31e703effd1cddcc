#include "twin/stop_text.h"

#include <fmt/format.h>

#include <vector>

namespace whirl_twin {

const char* describe(StepStatus status) {
  switch (status) {
    case StepStatus::kNotFinite:
      return "state not finite";
    case StepStatus::kNotConverged:
      return "implicit step did not converge";
    case StepStatus::kOutOfRange:
      return "its shaft runs at a speed that it was not prepared for";
    case StepStatus::kOk:
      break;
  }
  return "";
}

std::string stopText(const BuiltSystem& system, const SystemView& view, std::int64_t step,
                     double time) {
  const std::vector<CoordinateInfo> coordinates = system.dynamics->coordinates();
  std::string values;
  for (std::size_t i = 0; i < view.dof(); ++i) {
    const CoordinateInfo& c = coordinates[i];
    values += fmt::format("{}{} = {:.6g} {}, {}_rate = {:.6g} {}/s", i == 0 ? "" : ", ", c.name,
                          view.q()[i], c.unit, c.name, view.v()[i], c.unit);
  }
  return fmt::format("{}: stopped in step {} (t = {:.9g} s), {}; last good state: {}",
                     system.spec.name, step, time, describe(view.status()), values);
}

}  // namespace whirl_twin

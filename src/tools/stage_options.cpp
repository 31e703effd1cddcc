#include "tools/stage_options.h"

#include <limits>

namespace whirl_twin {

namespace {

OptionQuantity positive(const char* what, const char* unit) {
  return {what, unit, 0.0, std::numeric_limits<double>::infinity(), true};
}

}  // namespace

std::vector<Stage> StageOptions::all() const {
  std::vector<Stage> stages;
  for (const std::vector<double>& s : centrifugal) {
    stages.push_back({s[0], s[1], s[2], s[3], false});
  }
  for (const std::vector<double>& s : axial) {
    stages.push_back({s[0], s[1], s[2], 1.0, true});
  }
  return stages;
}

void addStageOptions(const ProgramCommand& command, StageOptions& options) {
  const OptionQuantity power = positive("a power", "W");
  const OptionQuantity diameter = positive("a diameter", "m");
  command
      .quantities("--stage", options.centrifugal,
                  {power, diameter, positive("a width", "m"), positive("a density ratio", "-")},
                  "power (W), diameter (m), width (m), density ratio of a centrifugal stage, > 0")
      .type("P D H RATIO");
  command
      .quantities("--axial-stage", options.axial,
                  {power, diameter, positive("a blade height", "m")},
                  "power (W), pitch diameter (m), blade height (m) of an axial stage, > 0")
      .type("P D H");
}

}  // namespace whirl_twin

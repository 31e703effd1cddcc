#include "twin/step_messages.h"

#include <algorithm>
#include <numeric>

#include "scene/changed_controller.h"
#include "scene/control_parts.h"

namespace whirl_twin {

namespace {

std::vector<std::size_t> allOf(std::size_t count) {
  std::vector<std::size_t> indices(count);
  std::iota(indices.begin(), indices.end(), 0);
  return indices;
}

}  // namespace

StepMessages::StepMessages(const BuiltScene& scene)
    : StepMessages(scene, allOf(scene.systems.size())) {
  for (const std::size_t drive : allOf(scene_drives_.size())) {
    drives_.insert(drive);
  }
}

StepMessages::StepMessages(const BuiltScene& scene, std::vector<std::size_t> systems)
    : built_(scene.systems),
      scene_drives_(scene.scene.drives),
      turned_by_(scene_drives_.size(), Twin::kNoSystem),
      systems_(std::move(systems)) {
  for (const ControllerSpec& controller : scene.scene.controllers) {
    if (std::any_of(systems_.begin(), systems_.end(),
                    [&](std::size_t system) { return involves(controller, system); })) {
      controllers_.push_back(controller_names_.size());
      if (hasParameters(controller)) {
        tunable_.push_back(controller_names_.size());
      }
    }
    controller_names_.push_back(controller.name);
  }
  published_.resize(systems_.size() + tunable_.size());
  for (std::size_t i = 0; i < built_.size(); ++i) {
    if (built_[i]->drive < turned_by_.size()) {
      turned_by_[built_[i]->drive] = i;
    }
  }
  for (const std::size_t system : systems_) {
    if (built_[system]->drive <
        scene_drives_.size()) {  // the others are constant speeds, not drives
      drives_.insert(built_[system]->drive);
    }
  }
}

}  // namespace whirl_twin

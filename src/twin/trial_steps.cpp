#include "twin/trial_steps.h"

#include <fmt/format.h>

#include <memory>

#include "integration/stepper.h"
#include "scene/control_parts.h"
#include "twin/stop_text.h"

namespace whirl_twin {

namespace {

constexpr int kSteps = 200;

}  // namespace

std::string whyItWouldStop(const BuiltScene& scene, const BuiltSystem& system,
                           std::optional<double> speed) {
  for (std::size_t i = 0; i < scene.systems.size(); ++i) {
    if (scene.systems[i]->spec.name == system.spec.name && isControlled(scene.scene, i)) {
      return "";  // it would move differently
    }
  }
  Drive drive = speed ? Drive(*speed, 0.0) : scene.driveOf(system);
  Inputs inputs = scene.inputsOf(system);
  const SystemSpec& spec = system.spec;
  const std::unique_ptr<Stepper> stepper = system.setup().system(
      system.integrator, {drive, &inputs}, scene.scene.stepSeconds(), spec.substeps);
  stepper->set(spec.q.data(), spec.v.data());
  for (int step = 0; step < kSteps; ++step) {
    const std::int64_t now = scene.scene.time + step * scene.scene.step;
    drive.begin(now);
    inputs.begin(now);
    const StepStatus status = stepper->step(static_cast<double>(now) / 1.0e9);
    if (status != StepStatus::kOk) {
      return fmt::format("{} would stop in step {} from the scene's start, {}", spec.name, step + 1,
                         describe(status));
    }
  }
  return "";
}

}  // namespace whirl_twin

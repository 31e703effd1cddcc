#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <utility>

#include "accuracy/step_choice.h"
#include "integration/step_methods.h"
#include "messages/input_error.h"
#include "messages/names.h"
#include "models/model_registry.h"
#include "reports/asked_cost.h"
#include "reports/rotor_systems.h"
#include "requests/durations.h"
#include "requests/simulation.h"
#include "scene/drive_reader.h"
#include "scene/model_context.h"
#include "scene/system_setup.h"

namespace whirl_twin {

namespace {

constexpr const char* kAllSensors = "sensors";

constexpr std::int64_t kMaxRun = 1'000'000'000 * kSecond;  // the maximum time of a drive
constexpr double kDefaultDuration = 10.0;                  // s

/// The longest drive profile, or 10 s, in whole samples.
std::int64_t defaultSteps(const SimulationPlan& plan) {
  double duration = 0.0;
  for (const DriveSpec& drive : plan.scene.drives) {
    duration = std::max(duration, profileDuration(drive));
  }
  if (duration == 0.0) {
    duration = kDefaultDuration;
  }
  if (duration > static_cast<double>(kMaxRun) / kSecond) {
    throw InputError(
        fmt::format("--duration: the drive's profile lasts {:.3g} s; give a duration up "
                    "to {}",
                    duration, inSeconds(kMaxRun)));
  }
  const double sample = plan.scene.stepSeconds() * static_cast<double>(plan.stride);
  // A duration of whole samples up to rounding is not extended by another one.
  return plan.stride * static_cast<std::int64_t>(std::ceil(duration / sample - 1.0e-6));
}

void overrideIntegrator(const std::string& name, SimulationPlan& plan) {
  const auto& names = integratorNames();
  if (std::find(names.begin(), names.end(), name) == names.end()) {
    throw InputError(fmt::format("--integrator: no integrator '{}'{}", name, hint(name, names)));
  }
  std::vector<std::string> objections;
  for (const std::size_t i : plan.systems) {
    SystemSpec& spec = plan.scene.systems[i];
    const ModelSetup& setup = setupOf(spec, surroundingsOf(plan.scene, spec)).made;
    const std::string objection = integratorDiagnostic(setup, spec.drive.has_value(), name);
    if (!objection.empty()) {
      objections.push_back(fmt::format("--integrator: {}: {}", spec.name, objection));
    }
    spec.integrator = name;
  }
  if (!objections.empty()) {
    throw InputError(fmt::format("{}", fmt::join(objections, "\ntwin: ")));
  }
}

/// The sensors of that name, or all of them.
std::vector<SensorSpec> selectedSensors(const Scene& scene, const std::string& name) {
  std::vector<SensorSpec> selected;
  std::vector<std::string> names{kAllSensors};
  for (const SensorSpec& sensor : scene.sensors) {
    names.push_back(sensor.name);
    if (name == sensor.name || name == kAllSensors) {
      selected.push_back(sensor);
    }
  }
  if (selected.empty()) {
    throw InputError(scene.sensors.empty()
                         ? fmt::format("--measure: {} has no sensors", scene.source)
                         : fmt::format("--measure: no sensors '{}' in {}{}", printable(name),
                                       scene.source, hint(name, names)));
  }
  return selected;
}

}  // namespace

SimulationPlan planSimulation(const SimulationRequest& request) {
  const SceneTree scene(request.scene);
  SimulationPlan plan = planSimulation(scene.scene(), request);
  plan.tree = scene.tree();
  plan.source = scene.absoluteSource();
  return plan;
}

SimulationPlan planSimulation(Scene scene, const SimulationRequest& request) {
  SimulationPlan plan;
  plan.scene = std::move(scene);
  plan.checkpoint = request.checkpoint;
  plan.resume = request.resume;
  plan.systems = selectedSystems(plan.scene, request.system);
  if (request.measure) {
    plan.sensors = selectedSensors(plan.scene, *request.measure);
  }
  if (request.step) {
    plan.scene.step = parseNanoseconds("--step", *request.step, 1, 10 * kSecond);
  }
  if (request.integrator) {
    overrideIntegrator(*request.integrator, plan);
  }
  const std::int64_t step = plan.scene.step;
  if (request.sample) {
    plan.stride = parseNanoseconds("--sample", *request.sample, step, kMaxRun, step) / step;
  }
  plan.scene = withStepsChosen(plan.scene);
  plan.steps = request.duration
                   ? parseNanoseconds("--duration", *request.duration, 0, kMaxRun, step) / step
                   : defaultSteps(plan);
  plan.insist = request.insist;
  tell(costOfRun(build(plan.scene)), plan.insist);
  return plan;
}

void warnOfExternalControllers(const Scene& scene) {
  for (const ControllerSpec& controller : scene.controllers) {
    if (controller.type == "external") {
      complain(
          fmt::format("twin: controllers.{}: runs in another process and acts only live; here its "
                      "output is 0\n",
                      controller.name));
    }
  }
}

std::string SimulationPlan::asked() const {
  int substeps = 1;
  std::size_t members = 0;
  for (const SystemSpec& system : scene.systems) {
    const std::string& method =
        system.chosen_integrator.empty() ? system.integrator : system.chosen_integrator;
    if (method == "auto" || !stepMethod(method).ahead) {
      substeps = std::max(substeps, system.substeps);
    }
    members = std::max(members, system.ensemble.count);
  }
  return fmt::format("--duration: {} s in {} steps{}{}",
                     static_cast<double>(steps) * scene.stepSeconds(), steps,
                     substeps > 1 ? fmt::format(", {} substeps each", substeps) : "",
                     members > 0 ? fmt::format(", of {} samples", members) : "");
}

}  // namespace whirl_twin

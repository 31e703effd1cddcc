#include "requests/scene_requests.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <memory>
#include <utility>
#include <vector>

#include "messages/input_error.h"
#include "reports/asked_cost.h"
#include "reports/figure.h"
#include "reports/loop_report.h"
#include "reports/rotor_systems.h"
#include "reports/system_analysis.h"
#include "requests/simulation.h"

namespace whirl_twin {

namespace {

constexpr double kFastest = 1.0e6;  // rad/s

/// The scene with every shaft at this speed [rad/s]. For a shaft on a motor it is part of the
/// state.
Scene withSpeed(Scene scene, const std::vector<std::size_t>& shown, double speed) {
  if (!(std::fabs(speed) <= kFastest)) {
    throw InputError("--speed: expected a shaft speed from -1e+06 to 1e+06 rad/s");
  }
  bool any = false;
  for (const std::size_t i : shown) {
    const SystemSpec& system = scene.systems[i];
    if (system.drive && scene.drives[scene.driveOf(system)].motor) {
      throw InputError(
          fmt::format("--speed: the speed of {} is not prescribed but follows from its motor; use "
                      "--at for an instant",
                      system.name));
    }
    any = any || system.drive || system.speed;
  }
  if (!any) {
    throw InputError("--speed: needs a system with a shaft, found none");
  }
  for (DriveSpec& drive : scene.drives) {
    if (!drive.motor) {
      drive.speed = speed;
      drive.profile.clear();
    }
  }
  for (SystemSpec& system : scene.systems) {
    if (system.speed) {
      system.speed = speed;
    }
  }
  return scene;
}

/// The scene in its state after so many seconds, its shafts kept at their speeds at that time.
Scene sceneAt(const Scene& given, const AnalyzeRequest& request, WorkProgress& progress) {
  SimulationRequest run;
  run.duration = request.at;
  run.insist = request.insist;
  const SimulationPlan plan = planSimulation(given, run);
  Simulation simulation(plan);
  simulation.run(nullptr, progress);
  if (!simulation.sound()) {
    throw RunFailure("--at: a system stopped before that time");
  }
  const Json systems = simulation.json()["systems"];
  const BuiltScene start = build(plan.scene);
  const std::int64_t elapsed = plan.steps * plan.scene.step;  // ns
  Scene scene = plan.scene;
  for (std::size_t i = 0; i < scene.systems.size(); ++i) {
    SystemSpec& system = scene.systems[i];
    const std::vector<CoordinateInfo> coordinates = start.systems[i]->dynamics->coordinates();
    for (std::size_t k = 0; k < coordinates.size(); ++k) {
      system.q[k] = systems[system.name]["state"][coordinates[k].name];
      system.v[k] = systems[system.name]["state"][coordinates[k].name + "_rate"];
    }
    if (system.drive) {
      const ShaftMotion shaft =
          start.driveOf(*start.systems[i]).at(static_cast<double>(elapsed) * 1.0e-9);
      DriveSpec& drive = scene.drives[scene.driveOf(system)];
      drive.speed = shaft.speed;
      drive.angle = shaft.angle;
      drive.profile.clear();
    }
  }
  scene.time += elapsed;
  return scene;
}

/// "all", or a number.
std::size_t modesAskedFor(const AnalyzeRequest& request) {
  if (request.modes == "all") {
    return kAllModes;
  }
  constexpr std::size_t kMaxDigits = 6;
  const bool number = !request.modes.empty() && request.modes.size() <= kMaxDigits &&
                      std::all_of(request.modes.begin(), request.modes.end(),
                                  [](char c) { return c >= '0' && c <= '9'; });
  const std::size_t modes = number ? std::stoul(request.modes) : 0;
  if (modes == 0) {
    throw InputError(
        fmt::format("--modes: expected the number of lowest modes, 1 or more, or all, found {}",
                    request.modes));
  }
  return modes;
}

}  // namespace

Document analyzeDocument(Scene scene, const AnalyzeRequest& request, WorkProgress& progress) {
  const std::size_t modes = modesAskedFor(request);
  const auto systems = selectedSystems(scene, request.system);
  if (request.at) {
    scene = sceneAt(scene, request, progress);
  }
  if (request.speed) {
    scene = withSpeed(std::move(scene), systems, *request.speed);
  }
  const BuiltScene built = build(scene);
  AskedCost cost;
  for (const std::size_t i : systems) {
    cost += costOfAnalysis(scene.systems[i].name, built.systems[i]->dynamics->dof(), modes);
  }
  tell(cost, request.insist);
  Document document;
  Json& all = document.json;
  all["scene"] = scene.name;
  for (const std::size_t i : systems) {
    const SystemAnalysis analysis = analyze(
        built, i, request.all_parameters ? ParameterSearch::kOfAll : ParameterSearch::kWhereQuick,
        modes);
    const MethodAnalysis methods = analyzeMethods(*built.systems[i], analysis);
    all["systems"][analysis.name] = json(analysis);
    all["systems"][analysis.name]["methods"] = json(methods, analysis);
    append(document.tables, analysis.name, tables(analysis));
    document.text += (document.text.empty() ? "" : "\n") + text(analysis, request.units) +
                     text(methods, analysis);
  }
  if (!scene.controllers.empty()) {
    const LoopReport loops = loopReport(scene);
    all["controllers"] = json(loops)["controllers"];
    document.text += "\n" + text(loops);
  }
  return document;
}

Document loopDocument(const Scene& scene, std::optional<double> speed) {
  if (speed && !(*speed >= -kFastest && *speed <= kFastest)) {
    throw InputError("--speed: expected a shaft speed from -1e+06 to 1e+06 rad/s");
  }
  if (scene.controllers.empty()) {
    throw InputError(scene.source + ": controllers: expected at least one, found none");
  }
  const auto kept = std::make_shared<const Scene>(scene);  // the report points at it
  const auto report = std::make_shared<const LoopReport>(loopReport(*kept, speed));
  Document document;
  document.json = json(*report);
  document.text = text(*report);
  for (std::size_t i = 0; i < report->controllers.size(); ++i) {
    const LoopedController& controller = report->controllers[i];
    if (!controller.responses.empty()) {
      document.drawings.push_back({controller.spec->name, [kept, report, i] {
                                     return figureJson(figure(report->controllers[i]));
                                   }});
    }
  }
  return document;
}

}  // namespace whirl_twin

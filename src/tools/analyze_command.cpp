#include <fmt/format.h>

#include <algorithm>
#include <memory>
#include <optional>
#include <utility>

#include "messages/input_error.h"
#include "reports/asked_cost.h"
#include "reports/loop_report.h"
#include "reports/rotor_systems.h"
#include "reports/system_analysis.h"
#include "tools/arguments.h"
#include "tools/commands.h"
#include "tools/report_options.h"
#include "tools/scene_argument.h"
#include "tools/simulation.h"

namespace whirl_twin {

namespace {

constexpr const char* kAnalyzeDescription =
    "Analyses each system of a scene at its start, or as --speed and --at specify: energies,\n"
    "equilibria, natural frequencies and damping, stability by Routh's test and its margins,\n"
    "critical speeds and separation margins.";

constexpr const char* kAnalyzeFooter =
    "Linearized about the operating point at the initial shaft speed: the stable equilibrium that\n"
    "the initial position approaches under strong damping (the nearest one where it does not "
    "move),\n"
    "or the initial state if there is none. For a nonlinear rotor it is the unstable equilibrium\n"
    "where no other exists, as above the threshold speed of oil films; where none is found the\n"
    "verdict is uncertain. Critical speeds are the peaks of the unbalance response; separation\n"
    "margins are those of API 617, in percent of the speed. A reduced-order rotor has none above "
    "the\n"
    "speed up to which the reduction is valid.\n"
    "The cross-coupling margin (API 617, level I) is the stiffness kxy = -kyx at the published\n"
    "station at which a whirl ceases to decay. Steady speeds: the motor's torque balances drag "
    "and\n"
    "whirl there; stable where the load rises faster with the speed than the torque.\n"
    "Each parameter of a stable system is changed alone, in finite increments, to its instability\n"
    "point: divergence (a real root crosses zero) or whirl or flutter (a pair crosses the "
    "imaginary\n"
    "axis). A range of instability narrower than an increment may be missed. In systems of more "
    "than\n"
    "eight coordinates, and in shafts of many elements, this takes minutes: only with "
    "--parameters.\n"
    "\n"
    "With more than 100 coordinates only the lowest modes are printed. That none of the others "
    "grows\n"
    "is proved by the definiteness of the matrices, or the verdict is uncertain: --modes all "
    "computes\n"
    "each mode. Critical speeds are then those up to the highest natural frequency printed.\n"
    "\n"
    "--speed sets the speed of every shaft; --at takes the motion after the given number of "
    "seconds,\n"
    "as `twin simulate` computes it, with the shafts at their speeds of that time.\n"
    "\n"
    "Examples:\n"
    "  twin analyze demo\n"
    "  twin analyze oil_whip --speed 200\n"
    "  twin analyze demo --system rotor --json";

struct AnalyzeRequest {
  SceneArgument scene;
  std::optional<std::string> system, csv, units;
  std::optional<double> speed;    // rad/s
  std::optional<std::string> at;  // s, as typed
  bool all_parameters = false;
  std::string modes = std::to_string(kLowestModes);  // as typed
  bool json = false;
  bool insist = false;
};

/// The scene with every shaft at this speed [rad/s]. For a shaft on a motor it is part of the
/// state.
Scene withSpeed(Scene scene, const std::vector<std::size_t>& shown, double speed) {
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
Scene sceneAt(const AnalyzeRequest& request) {
  SimulationRequest run;
  run.scene = request.scene;
  run.duration = request.at;
  run.insist = request.insist;
  const SimulationPlan plan = planSimulation(run);
  Simulation simulation(plan);
  simulation.run(nullptr, true);
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

int analyzeScene(const AnalyzeRequest& request) {
  requireCsvName(request.csv);
  const std::size_t modes = modesAskedFor(request);
  Scene scene = sceneOf(request.scene);
  const auto systems = selectedSystems(scene, request.system);
  if (request.at) {
    scene = sceneAt(request);
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
  Json all;
  all["scene"] = scene.name;
  const ShownUnits units = chosenUnits(request.units);
  std::string report;
  CsvTables csv;
  for (const std::size_t i : systems) {
    const SystemAnalysis analysis = analyze(
        built, i, request.all_parameters ? ParameterSearch::kOfAll : ParameterSearch::kWhereQuick,
        modes);
    const MethodAnalysis methods = analyzeMethods(*built.systems[i], analysis);
    all["systems"][analysis.name] = json(analysis);
    all["systems"][analysis.name]["methods"] = json(methods, analysis);
    append(csv, analysis.name, tables(analysis));
    report += (report.empty() ? "" : "\n") + text(analysis, units) + text(methods, analysis);
  }
  if (!scene.controllers.empty()) {
    const LoopReport loops = loopReport(scene);
    all["controllers"] = json(loops)["controllers"];
    report += "\n" + text(loops);
  }
  if (request.csv) {
    writeCsv(*request.csv, csv);
  }
  return printReport(request.json, all, report);
}

}  // namespace

void addAnalyzeCommand(const ProgramCommand& twin, int& status) {
  const ProgramCommand command = twin.subcommand("analyze", kAnalyzeDescription);
  const auto request = std::make_shared<AnalyzeRequest>();
  addSceneOption(command, request->scene);
  command.option("--system", request->system, "show this system only").type("NAME");
  command
      .quantity("--speed", request->speed, kSignedShaftSpeed, "speed of the shafts",
                "that at the start")
      .type("W");
  command.option("--at", request->at, "simulated time since the start [s]; default: 0").type("S");
  command
      .option(
          "--modes", request->modes,
          fmt::format("number of lowest modes, or all, with more than {} coordinates; default: {}",
                      kMaxCompleteCoordinates, kLowestModes))
      .type("N");
  command.flag("--parameters", request->all_parameters,
               "compute the instability points of the parameters also where that takes minutes");
  addCsvOption(command, request->csv);
  addUnitsOption(command, request->units);
  addJsonOption(command, request->json);
  addInsistOption(command, request->insist);
  command.takeUnits();
  command.footer(kAnalyzeFooter);
  command.callback([request, &status] { status = analyzeScene(*request); });
}

}  // namespace whirl_twin

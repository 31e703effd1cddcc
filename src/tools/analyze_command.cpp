#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <memory>
#include <optional>
#include <utility>

#include "messages/refusal.h"
#include "reports/asked_cost.h"
#include "reports/loop_report.h"
#include "reports/method_analysis.h"
#include "reports/selected_systems.h"
#include "reports/system_analysis.h"
#include "scene/scene_reader.h"
#include "tools/arguments.h"
#include "tools/commands.h"
#include "tools/shipped_scenes.h"
#include "tools/simulation.h"

namespace whirl_twin {

namespace {

constexpr const char* kAnalyzeDescription =
    "Judges each system of a scene at its start, or where --speed and --at say: energies, "
    "equilibria, natural frequencies and\n"
    "damping, stability by Routh's test and its margins, critical speeds and separation margins.";

constexpr const char* kAnalyzeFooter =
    "Linearized about the operating point at the initial shaft speed: the stable equilibrium that\n"
    "the initial position creeps to, strongly damped (the nearest where it does not move), or the\n"
    "initial state if there is none. Of a nonlinear rotor it is the unstable equilibrium where no\n"
    "other exists, as above its threshold in oil films; where none is found the verdict is\n"
    "uncertain. Critical speeds are the peaks of the unbalance response;\n"
    "separation margins are those of API 617, in percent of the speed. Of a reduced rotor none is\n"
    "told beyond the speed that it holds to.\n"
    "The cross-coupling margin (API 617, level I) is the stiffness kxy = -kyx at the published\n"
    "station at which a whirl stops to decay. Steady speeds: the motor's torque\n"
    "carries drag and whirl there; stable where the load rises faster with the speed.\n"
    "Each number of a stable system is changed alone, in strides, to where stability is lost: by\n"
    "divergence (a real root passes zero) or by whirl or flutter (a pair passes the axis). An "
    "isle\n"
    "of instability narrower than a stride may be jumped over. In systems of more than eight\n"
    "coordinates, and in shafts of many elements, that takes minutes: with --parameters.\n"
    "\n"
    "Of more than 100 coordinates the lowest modes are told. That none of the others grows is "
    "proved\n"
    "from the definiteness of the matrices, or the verdict is uncertain: --modes all looks at "
    "each.\n"
    "Critical speeds are then those up to the highest natural frequency that is told.\n"
    "\n"
    "--speed holds every shaft at a speed; --at takes the motion after so many seconds, as "
    "`twin\n"
    "simulate` has it, with the shafts held at their speeds of then.\n"
    "\n"
    "Examples:\n"
    "  twin analyze demo\n"
    "  twin analyze oil_whip --speed 200\n"
    "  twin analyze demo --system rotor --json";

struct AnalyzeRequest {
  std::string scene;
  std::optional<std::string> system, csv;
  std::optional<double> speed;    // rad/s
  std::optional<std::string> at;  // s, as typed
  bool all_parameters = false;
  std::string modes = std::to_string(kLowestModes);  // as typed
  bool json = false;
  bool insist = false;
};

/// The scene with every shaft at this speed [rad/s]. Of a shaft on a motor it is part of the
/// motion.
Scene withSpeed(Scene scene, const std::vector<std::size_t>& shown, double speed) {
  constexpr double kFastest = 1.0e6;
  if (!(std::fabs(speed) <= kFastest)) {
    throw Refusal("--speed: expected a shaft speed from -1e+06 to 1e+06 rad/s");
  }
  bool any = false;
  for (const std::size_t i : shown) {
    const SystemSpec& system = scene.systems[i];
    if (system.drive && scene.drives[scene.driveOf(system)].motor) {
      throw Refusal(fmt::format(
          "--speed: {} is on a motor, which makes its speed; --at tells of a moment", system.name));
    }
    any = any || system.drive || system.speed;
  }
  if (!any) {
    throw Refusal("--speed: there is no system on a shaft");
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

/// The scene as it has come to be after so many seconds, its shafts held at their speeds of then.
Scene sceneAt(const AnalyzeRequest& request) {
  SimulationRequest run;
  run.scene = request.scene;
  run.duration = request.at;
  run.insist = request.insist;
  const SimulationPlan plan = planSimulation(run);
  Simulation simulation(plan);
  simulation.run(nullptr, true);
  if (!simulation.sound()) {
    throw RunFailure("--at: there is no motion left of what has stopped");
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
  constexpr std::size_t kMostDigits = 6;
  const bool number = !request.modes.empty() && request.modes.size() <= kMostDigits &&
                      std::all_of(request.modes.begin(), request.modes.end(),
                                  [](char c) { return c >= '0' && c <= '9'; });
  const std::size_t modes = number ? std::stoul(request.modes) : 0;
  if (modes == 0) {
    throw Refusal(fmt::format(
        "--modes: expected how many of the lowest, 1 or more, or all, found {}", request.modes));
  }
  return modes;
}

int analyzeScene(const AnalyzeRequest& request) {
  requireCsvName(request.csv);
  const std::size_t modes = modesAskedFor(request);
  Scene scene = readSceneFile(scenePath(request.scene));
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
    report += (report.empty() ? "" : "\n") + text(analysis) + text(methods, analysis);
  }
  if (!scene.controllers.empty()) {
    const LoopReport loops = loopReport(scene);
    all["controllers"] = json(loops)["controllers"];
    report += "\n" + text(loops);
  }
  if (request.csv) {
    writeCsv(*request.csv, csv);
  }
  if (request.json) {
    printJson(all);
  } else {
    printText(report);
  }
  return kDone;
}

}  // namespace

void addAnalyzeCommand(const ProgramCommand& twin, int& status) {
  const ProgramCommand command = twin.subcommand("analyze", kAnalyzeDescription);
  const auto request = std::make_shared<AnalyzeRequest>();
  addSceneOption(command, request->scene);
  command.option("--system", request->system, "show this system only").type("NAME");
  command.option("--speed", request->speed, "rad/s, of the shafts; default: at the start")
      .type("W");
  command.option("--at", request->at, "s, simulated, from the start to there; default: 0")
      .type("S");
  command
      .option("--modes", request->modes,
              fmt::format("how many of the lowest, or all, of more than {} coordinates; "
                          "default: {}",
                          kMostCompleteCoordinates, kLowestModes))
      .type("N");
  command.flag("--parameters", request->all_parameters,
               "look for the numbers that stability is lost by where that takes minutes, too");
  addCsvOption(command, request->csv);
  command.flag("--json", request->json, "print one JSON object");
  addInsistOption(command, request->insist);
  command.footer(kAnalyzeFooter);
  command.callback([request, &status] { status = analyzeScene(*request); });
}

}  // namespace whirl_twin

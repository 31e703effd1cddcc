#include <memory>
#include <optional>

#include "reports/asked_cost.h"
#include "reports/loop_report.h"
#include "reports/method_analysis.h"
#include "reports/selected_systems.h"
#include "reports/system_analysis.h"
#include "scene/scene_reader.h"
#include "tools/arguments.h"
#include "tools/commands.h"
#include "tools/shipped_scenes.h"

namespace whirl_twin {

namespace {

constexpr const char* kDescription =
    "Judges each system of a scene at its start: energies, equilibria, natural frequencies and\n"
    "damping, stability by Routh's test and its margins, critical speeds and separation margins.";

constexpr const char* kFooter =
    "Linearized about the operating point at the initial shaft speed: the stable equilibrium that\n"
    "the initial position creeps to, strongly damped (the nearest where it does not move), or the\n"
    "initial state if there is none. Critical speeds are the peaks of the unbalance response;\n"
    "separation margins are those of API 617, in percent of the speed. Of a reduced rotor none is\n"
    "told beyond the speed that it holds to.\n"
    "The cross-coupling margin (API 617, level I) is the stiffness kxy = -kyx at the published\n"
    "station at which the first forward whirl stops to decay. Steady speeds: the motor's torque\n"
    "carries drag and whirl there; stable where the load rises faster with the speed.\n"
    "Each number of a stable system is changed alone, in strides, to where stability is lost: by\n"
    "divergence (a real root passes zero) or by whirl or flutter (a pair passes the axis). An "
    "isle\n"
    "of instability narrower than a stride may be jumped over. In systems of more than eight\n"
    "coordinates, and in shafts of many elements, that takes minutes: with --parameters.\n"
    "\n"
    "Examples:\n"
    "  twin analyze demo.yaml\n"
    "  twin analyze demo.yaml --system rotor --json";

struct Request {
  std::string scene;
  std::optional<std::string> system;
  ParameterSearch search = ParameterSearch::kWhereQuick;
  bool json = false;
  bool insist = false;
};

int analyzeScene(const Request& request) {
  const Scene scene = readSceneFile(scenePath(request.scene));
  const auto systems = selectedSystems(scene, request.system);
  const BuiltScene built = build(scene);
  AskedCost cost;
  for (const std::size_t i : systems) {
    cost += costOfAnalysis(scene.systems[i].name, built.systems[i]->dynamics->dof());
  }
  tell(cost, request.insist);
  Json all;
  all["scene"] = scene.name;
  std::string report;
  for (const std::size_t i : systems) {
    const SystemAnalysis analysis = analyze(built, i, request.search);
    const MethodAnalysis methods = analyzeMethods(*built.systems[i], analysis);
    all["systems"][analysis.name] = json(analysis);
    all["systems"][analysis.name]["methods"] = json(methods, analysis);
    report += (report.empty() ? "" : "\n") + text(analysis) + text(methods, analysis);
  }
  if (!scene.controllers.empty()) {
    const LoopReport loops = loopReport(scene);
    all["controllers"] = json(loops)["controllers"];
    report += "\n" + text(loops);
  }
  if (request.json) {
    printJson(all);
  } else {
    printText(report);
  }
  return kDone;
}

}  // namespace

void addAnalyzeCommand(CLI::App& twin, int& status) {
  CLI::App* command = twin.add_subcommand("analyze", kDescription);
  const auto request = std::make_shared<Request>();
  addSceneOption(command, request->scene);
  command->add_option("--system", request->system, "show this system only")->type_name("NAME");
  command->add_flag_callback(
      "--parameters", [request] { request->search = ParameterSearch::kOfAll; },
      "look for the numbers that stability is lost by where that takes minutes, too");
  command->add_flag("--json", request->json, "print one JSON object");
  addInsistOption(command, request->insist);
  command->footer(kFooter);
  command->callback([request, &status] { status = analyzeScene(*request); });
}

}  // namespace whirl_twin

#include <fmt/format.h>

#include <memory>
#include <optional>

#include "requests/scene_requests.h"
#include "tools/arguments.h"
#include "tools/commands.h"
#include "tools/interrupt.h"
#include "tools/progress_bar.h"
#include "tools/report_options.h"

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

struct AnalyzeOptions {
  SceneArgument scene;
  std::optional<std::string> csv, units;
  bool json = false;
  AnalyzeRequest request;
};

int analyzeScene(AnalyzeOptions& options) {
  requireCsvName(options.csv);
  if (options.request.at) {
    catchInterrupts();
  }
  options.request.units = chosenUnits(options.units);
  TerminalProgress progress(true);
  const Document document = analyzeDocument(sceneOf(options.scene), options.request, progress);
  return printDocument(document, options.json, options.csv);
}

}  // namespace

void addAnalyzeCommand(const ProgramCommand& twin, int& status) {
  const ProgramCommand command = twin.subcommand("analyze", kAnalyzeDescription);
  const auto options = std::make_shared<AnalyzeOptions>();
  AnalyzeRequest* const request = &options->request;
  addSceneOption(command, options->scene);
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
  addCsvOption(command, options->csv);
  addUnitsOption(command, options->units);
  addJsonOption(command, options->json);
  addInsistOption(command, request->insist);
  command.takeUnits();
  command.footer(kAnalyzeFooter);
  command.callback([options, &status] { status = analyzeScene(*options); });
}

}  // namespace whirl_twin

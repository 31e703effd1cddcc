#include <fmt/format.h>

#include <algorithm>
#include <filesystem>
#include <memory>

#include "messages/input_error.h"
#include "reports/output.h"
#include "reports/sample_writer.h"
#include "requests/simulation.h"
#include "scene/yaml_file.h"
#include "tools/arguments.h"
#include "tools/commands.h"
#include "tools/interrupt.h"
#include "tools/progress_bar.h"
#include "twin/scene_lines.h"

namespace whirl_twin {

namespace {

constexpr const char* kSimulateDescription =
    "Runs a scene from its start, as fast as possible, and writes the motion: a table of\n"
    "comma-separated values, an LCM log, an MCAP file, or with --json the final state.";

constexpr const char* kSimulateFooter =
    "The table has a row at the start and one every sample up to and including the duration:\n"
    "  time, then for each system its coordinates, their rates (NAME_rate) and, for a rotor,\n"
    "  whirl_radius (m) and whirl_phase (rad, lag of the whirl behind the shaft's phase mark, "
    "unwrapped).\n"
    "17 significant digits; nan where a value is undefined or a system has stopped. Same input,\n"
    "same build: same bytes. A file appears only when it is complete.\n"
    "\n"
    "A run resumed from a checkpoint has a row at its start and then the rows of an "
    "uninterrupted\nrun, byte for byte.\n"
    "\n"
    "A system that diverges is reported on standard error with its last valid state; the "
    "others\ncontinue to the end, and the exit status is 1.\n"
    "\n"
    "Examples:\n"
    "  twin simulate demo --sample 0.01 --output demo.csv\n"
    "  twin simulate demo --duration 60 --output demo.lcmlog     for twin play\n"
    "  twin simulate demo --duration 60 --output demo.mcap       for PlotJuggler, Lichtblick\n"
    "  twin simulate demo --duration 1e4 --checkpoint run.checkpoint --json\n"
    "  twin simulate demo --system pendulum --integrator runge_kutta_4 --step 0.0005 --json";

/// ".csv", ".lcmlog" or ".mcap". Throws InputError.
std::string extensionOf(const std::string& output) {
  std::string extension = std::filesystem::path(output).extension();
  if (extension != ".csv" && extension != ".lcmlog" && extension != ".mcap") {
    throw InputError(
        fmt::format("--output: must end in .csv, .lcmlog or .mcap, found '{}'", output));
  }
  return extension;
}

/// The scene with the replacements of the options.
state::SceneText simulatedScene(const SimulationRequest& request, const SimulationPlan& plan) {
  YAML::Node tree = YAML::Clone(plan.tree);
  if (request.step) {
    tree["step"] = *request.step;
  }
  for (const std::size_t i : request.integrator ? plan.systems : std::vector<std::size_t>{}) {
    tree["systems"][plan.scene.systems[i].name]["integrator"] = *request.integrator;
  }
  return sceneText(tree, plan.source);
}

std::unique_ptr<SampleWriter> makeWriter(const SimulationRequest& request,
                                         const SimulationPlan& plan, const Twin& twin) {
  const std::vector<std::size_t>& systems = plan.systems;
  if (!request.output) {
    return request.json ? nullptr : makeTableWriter(twin, systems, "");
  }
  return extensionOf(*request.output) == ".csv"
             ? makeTableWriter(twin, systems, *request.output)
             : makeLogWriter(twin, systems, simulatedScene(request, plan), *request.output);
}

void requireOneEnsemble(const SimulationPlan& plan) {
  const auto ensembles =
      std::count_if(plan.systems.begin(), plan.systems.end(),
                    [&](std::size_t i) { return plan.scene.systems[i].ensemble.count > 0; });
  if (ensembles != 1) {
    throw InputError(fmt::format("--members: needs one system with a count, found {}{}", ensembles,
                                 ensembles > 1 ? "; choose one by --system" : ""));
  }
}

int simulate(const SimulationRequest& request) {
  if (request.output) {
    extensionOf(*request.output);
  }
  if (request.measure && (!request.output || extensionOf(*request.output) == ".csv")) {
    throw InputError("--measure: needs --output FILE.lcmlog or FILE.mcap for the measurements");
  }
  if (request.members && std::filesystem::path(*request.members).extension() != ".csv") {
    throw InputError(fmt::format("--members: must end in .csv, found '{}'", *request.members));
  }
  if (request.members && request.members == request.output) {
    throw InputError("--members: must differ from --output");
  }
  if (request.measure && request.resume) {
    throw InputError("--measure: must not be given with --resume");
  }
  const SimulationPlan plan = planSimulation(request);
  warnOfExternalControllers(plan.scene);
  if (request.members) {
    requireOneEnsemble(plan);
  }
  catchInterrupts();  // before a writer opens its file, which an interrupted run removes
  Simulation simulation(plan);
  const auto writer = makeWriter(request, plan, simulation.twin());
  TerminalProgress progress(!request.output && !request.json);
  simulation.run(writer.get(), progress);
  if (writer) {
    writer->finish();
  }
  if (request.members) {
    writeMembers(simulation.twin(), plan.systems, *request.members);
  }
  if (request.json) {
    printJson(simulation.json());
  }
  return simulation.sound() ? kDone : kFailed;
}

}  // namespace

void addSimulateCommand(const ProgramCommand& twin, int& status) {
  const ProgramCommand command = twin.subcommand("simulate", kSimulateDescription);
  const auto request = std::make_shared<SimulationRequest>();
  addSceneOption(command, request->scene);
  command
      .option("--duration", request->duration,
              "s, simulated, to the nearest step; default: the longest drive profile, else 10 s")
      .type("S");
  command.option("--step", request->step, "s, instead of the scene's: 1e-9 to 10").type("S");
  command
      .option("--integrator", request->integrator,
              "instead of the scene's, for all systems or that of --system")
      .type("NAME");
  command
      .option("--sample", request->sample, "s between rows, to the nearest step; default: a step")
      .type("S");
  command
      .option("--output", request->output,
              "FILE.csv, FILE.lcmlog or FILE.mcap; default: a table on standard output")
      .type("FILE");
  command
      .option("--members", request->members,
              "FILE.csv: of a system with a count, the parameters and results of each sample")
      .type("FILE");
  command
      .option("--measure", request->measure,
              "the name of sensors of the scene, or `sensors` for all of them: their\nmeasurements "
              "are written to the log too")
      .type("NAME");
  command
      .option("--checkpoint", request->checkpoint,
              "file in which the run is saved every 5 s of wall time, at its end, and when it is "
              "interrupted")
      .type("FILE");
  command
      .option("--resume", request->resume,
              "a checkpoint of the same scene: resume from it, bit-identical, up to --duration, "
              "which counts from the scene's start")
      .type("FILE");
  command.option("--system", request->system, "show this system only").type("NAME");
  command.flag("--json", request->json, "print the final state as one JSON object");
  addInsistOption(command, request->insist);
  command.takeUnits();
  command.footer(kSimulateFooter);
  command.callback([request, &status] { status = simulate(*request); });
}

}  // namespace whirl_twin

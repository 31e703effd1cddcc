#include <fmt/format.h>

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <memory>
#include <optional>
#include <vector>

#include "messages/input_error.h"
#include "reports/drawings.h"
#include "reports/output.h"
#include "reports/study_report.h"
#include "reports/system_plots.h"
#include "requests/simulation.h"
#include "scene/yaml_file.h"
#include "studies/study_reader.h"
#include "tools/arguments.h"
#include "tools/commands.h"
#include "tools/interrupt.h"
#include "tools/progress_bar.h"

namespace whirl_twin {

namespace {

constexpr const char* kPlotDescription =
    "Runs a scene from its start and draws the result: for each system a picture, its "
    "time\nhistory, its phase portrait and its energies. Or draws the results of a study, or "
    "figures "
    "that\nwere written as JSON over each other.";

constexpr const char* kPlotFooter =
    "Files in the folder, for each system, as svg, png, pdf or json (the data of the figure):\n"
    "  NAME_picture   to scale, at the start, with later positions and the path of a point;\n"
    "                 a model given by its matrices and a whirling disc have none\n"
    "  NAME_time      its coordinates; of a rotor whirl radius, phase lag where the whirl goes "
    "with\n"
    "                 the shaft, and shaft speed, with marks where that passes a critical speed\n"
    "  NAME_phase     the rate of each coordinate over it; of a rotor the orbit\n"
    "  NAME_energy    kinetic and potential energy, and h\n"
    "  NAME_ensemble  of a system with a count: percentiles over time, and the samples' peaks\n"
    "Of a study, with the results of `twin sweep`, for each measure:\n"
    "  NAME_histogram percentiles, and the limits of what is required\n"
    "  NAME_scatter   over each varied parameter; one at a time: its curve over each\n"
    "  NAME_tornado   its sensitivity to each: sobol_indices, morris, one_at_a_time\n"
    "  NAME_map       over both parameters of a grid of two\n"
    "Of figures, FILE.json as SCENE and --over: their curves over each other, FILE_OTHER.FORMAT;\n"
    "they must be charts over the same axes.\n"
    "The folder and its files appear only when all of them are complete.\n"
    "\n"
    "Examples:\n"
    "  twin plot double_pendulum --system absolute --duration 20\n"
    "  twin plot my_scene.yaml --output pictures --format png\n"
    "  twin plot study.yaml --results results --output pictures\n"
    "  twin plot chaos_first_time.json --over chaos_second_time.json";

constexpr std::int64_t kMaxSamples = 100'000;
constexpr std::int64_t kEnsembleSamples = 600;

struct PlotRequest {
  SimulationRequest run;
  std::optional<std::string> results;  // of a study, given in place of the scene
  std::vector<std::string> over;       // figures, drawn over one given in place of the scene
  std::string folder = ".";
  std::string format = "svg";
};

/// NAME_KIND.FORMAT in the folder.
void add(Drawings& drawings, const PlotRequest& request, const std::string& name,
         const std::string& kind, const Json& figure) {
  const std::string file = fmt::format("{}_{}.{}", name, kind, request.format);
  drawings.add((std::filesystem::path(request.folder) / file).string(), figure);
}

/// Draws, and prints the names of the files.
/// @return are there any?
bool complete(Drawings& drawings) {
  const std::vector<std::string> paths = drawings.write();
  printText(joined(paths, [](const std::string& path) { return path + "\n"; }));
  return !paths.empty();
}

/// An output folder, created with its parents if missing. Created folders are removed again unless
/// files are written into them.
class OutputFolder {
 public:
  /// Throws InputError if the name is that of another kind of file, RunFailure if it cannot be
  /// created.
  explicit OutputFolder(const std::string& name) {
    namespace fs = std::filesystem;
    std::error_code error;
    for (fs::path folder = fs::absolute(name); !fs::exists(folder, error);
         folder = folder.parent_path()) {
      made_.push_back(folder);
    }
    fs::create_directories(name, error);
    if (fs::exists(name) && !fs::is_directory(name)) {
      throw InputError(fmt::format("--output: must be a folder, found '{}'", name));
    }
    if (!fs::is_directory(name)) {
      throw RunFailure(fmt::format("{}: cannot be created: {}", name, error.message()));
    }
  }
  ~OutputFolder() {
    for (const std::filesystem::path& folder : made_) {
      std::error_code not_empty;
      std::filesystem::remove(folder, not_empty);
    }
  }
  OutputFolder(const OutputFolder&) = delete;
  OutputFolder& operator=(const OutputFolder&) = delete;

 private:
  std::vector<std::filesystem::path> made_;  // the innermost first
};

int plotStudy(const PlotRequest& request) {
  if (request.run.system || request.run.duration) {
    throw InputError(fmt::format("{}: needs a scene, found the results of a study",
                                 request.run.system ? "--system" : "--duration"));
  }
  const Study study = readStudy(request.run.scene.name);
  if (study.optimization) {
    throw InputError(fmt::format("{}: an optimization has no points to draw", study.source));
  }
  if (!std::filesystem::exists(*request.results + "/manifest.yaml")) {
    throw InputError(fmt::format("--results: {} has no results of a study", *request.results));
  }
  const ResultFolder results(*request.results, study, true);
  const StudyStatus status = statusOf(study, results);
  if (status.done < study.points()) {
    throw RunFailure(fmt::format("{}: {} of {} points are done: run the others first",
                                 *request.results, status.done, study.points()));
  }
  const StudyTable table = results.merge();
  const OutputFolder made(request.folder);
  Drawings drawings;
  for (const StudyPlot& plot : studyPlots(study, table, answersOf(study, table))) {
    add(drawings, request, plot.measure, plot.kind, plot.figure);
  }
  if (!complete(drawings)) {
    throw RunFailure(fmt::format("{}: no measure is finite anywhere", *request.results));
  }
  return kDone;
}

/// Of a figure's file.
Json readFigure(const std::string& path) {
  std::ifstream file(path);
  const Json figure = Json::parse(file, nullptr, false);
  if (!figure.is_object() || !figure.contains("kind")) {
    throw InputError(
        fmt::format("{}: must be the data of a figure, as --plot FILE.json and --format "
                    "json write it",
                    path));
  }
  return figure;
}

int plotFigures(const PlotRequest& request) {
  if (request.format == "json") {
    throw InputError("--format: must be svg, png or pdf for figures, found 'json'");
  }
  Json figures = Json::object();
  std::string name;
  const auto take = [&](const std::string& path) {
    const std::string stem = std::filesystem::path(path).stem().string();
    const Json figure = readFigure(path);
    figures[figures.contains(stem) ? path : stem] = figure;
    name += (name.empty() ? "" : "_") + stem;
  };
  take(request.run.scene.name);
  std::for_each(request.over.begin(), request.over.end(), take);
  const OutputFolder made(request.folder);
  Drawings drawings;
  drawings.addOverlaid(
      (std::filesystem::path(request.folder) / (name + "." + request.format)).string(), figures);
  complete(drawings);
  return kDone;
}

/// Detects a study given in place of a scene, for a helpful error.
bool isStudy(const std::string& path) {
  if (!std::filesystem::is_regular_file(path)) {
    return false;
  }
  try {
    const YAML::Node tree = readYamlFile(path, "a scene", "systems");
    return tree.IsMap() && tree["study"] && tree["measure"];
  } catch (const InputError&) {  // the reader of scenes reports why
    return false;
  }
}

int plot(const PlotRequest& request) {
  if (figureFormat("plot." + request.format).empty()) {
    throw InputError(
        fmt::format("--format: must be svg, png, pdf or json, found '{}'", request.format));
  }
  if (figureFormat(request.run.scene.name) == "json") {
    return plotFigures(request);
  }
  if (!request.over.empty()) {
    throw InputError(
        fmt::format("--over: needs a figure, FILE.json, in place of the scene, found {}",
                    request.run.scene.name));
  }
  if (request.results) {
    return plotStudy(request);
  }
  if (isStudy(request.run.scene.name)) {
    throw InputError("--results: missing; must be the folder written by `twin sweep`");
  }
  SimulationPlan plan = planSimulation(request.run);
  const OutputFolder made(request.folder);
  plan.stride = 1 + plan.steps / kMaxSamples;
  catchInterrupts();
  Simulation simulation(plan);
  const std::int64_t samples = plan.steps / plan.stride;
  PlotHistoryWriter writer(simulation.twin(), plan.systems, 1 + samples / kEnsembleSamples);
  TerminalProgress progress(false);
  simulation.run(&writer, progress);

  Drawings drawings;
  for (std::size_t i = 0; i < plan.systems.size(); ++i) {
    const BuiltSystem& system = *simulation.twin().systems()[plan.systems[i]];
    const Ensemble* const ensemble = simulation.twin().ensemble(plan.systems[i]);
    for (const SystemPlot& plot : systemPlots(system, ensemble, writer.histories()[i])) {
      add(drawings, request, system.spec.name, plot.kind, plot.figure);
    }
  }
  complete(drawings);
  return simulation.sound() ? kDone : kFailed;
}

}  // namespace

void addPlotCommand(const ProgramCommand& twin, int& status) {
  const ProgramCommand command = twin.subcommand("plot", kPlotDescription);
  const auto request = std::make_shared<PlotRequest>();
  addSceneOption(command, request->run.scene);
  command.option("--system", request->run.system, "plot only this system").type("NAME");
  command
      .option("--duration", request->run.duration,
              "s, simulated, to the nearest step; default: the longest drive profile, else 10 s")
      .type("S");
  command
      .option("--results", request->results, "folder of a study's results; SCENE is then the study")
      .type("FOLDER");
  command
      .option("--over", request->over, "figures drawn over one; SCENE is then its FILE.json, too")
      .type("FILE.json");
  command
      .option("--output", request->folder,
              "folder of the files, created if missing; default: the current one")
      .type("FOLDER");
  command.option("--format", request->format, "svg, png, pdf, or json: its data; default: svg")
      .type("FORMAT");
  addInsistOption(command, request->run.insist);
  command.takeUnits();
  command.footer(kPlotFooter);
  command.callback([request, &status] { status = plot(*request); });
}

}  // namespace whirl_twin

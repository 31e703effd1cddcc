#include <fmt/format.h>

#include <cerrno>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <memory>

#include "messages/refusal.h"
#include "reports/output.h"
#include "reports/plot_history.h"
#include "reports/system_plots.h"
#include "tools/arguments.h"
#include "tools/commands.h"
#include "tools/simulation.h"

namespace whirl_twin {

namespace {

constexpr const char* kDescription =
    "Runs a scene from its start and draws what happens: for each system a picture, its time\n"
    "history, its phase portrait and its energies.";

constexpr const char* kFooter =
    "Into the folder, for each system, as svg (sharp at any size) or png:\n"
    "  NAME_picture   to scale, at the start, with later positions and the path of a point;\n"
    "                 a model given by its matrices and a whirling disc have none\n"
    "  NAME_time      its coordinates; of a rotor whirl radius, phase and shaft speed\n"
    "  NAME_phase     the rate of each coordinate over it; of a rotor the orbit\n"
    "  NAME_energy    kinetic and potential energy, and h\n"
    "  NAME_ensemble  of a system with a count: percentiles over time, and the members' peaks\n"
    "Files appear only when all of them are complete, and so does the folder.\n"
    "\n"
    "Examples:\n"
    "  twin plot double_pendulum --system absolute --duration 20\n"
    "  twin plot my_scene.yaml --output pictures --format png";

constexpr std::int64_t kMostSamples = 100'000;
constexpr std::int64_t kEnsembleSamples = 600;

struct PlotRequest {
  SimulationRequest run;
  std::string folder = ".";
  std::string format = "svg";
};

ImageFormat formatOf(const std::string& name) {
  if (name != "svg" && name != "png") {
    throw Refusal(fmt::format("--format: must be svg or png, found '{}'", name));
  }
  return imageFormat("plot." + name);
}

/// A file whose contents wait for the others'.
class WaitingFile {
 public:
  WaitingFile(const std::string& path, const std::string& contents) : pending_(path), path_(path) {
    std::ofstream file(pending_.path(), std::ios::binary);
    file << contents;
    file.close();
    if (!file) {
      throw RunFailure(fmt::format("{}: cannot be written: {}", path, std::strerror(errno)));
    }
  }
  void complete() {
    pending_.complete();
    printText(path_ + "\n");
  }

 private:
  PendingFile pending_;
  std::string path_;
};

/// A folder to write into, made with those above it where it is not there. What was made goes again
/// unless files come into it.
class OutputFolder {
 public:
  /// Throws Refusal if there is something else of that name, RunFailure if it cannot be made.
  explicit OutputFolder(const std::string& name) {
    namespace fs = std::filesystem;
    std::error_code error;
    for (fs::path folder = fs::absolute(name); !fs::exists(folder, error);
         folder = folder.parent_path()) {
      made_.push_back(folder);
    }
    fs::create_directories(name, error);
    if (fs::exists(name) && !fs::is_directory(name)) {
      throw Refusal(fmt::format("--output: must be a folder, found '{}'", name));
    }
    if (!fs::is_directory(name)) {
      throw RunFailure(fmt::format("{}: cannot be made: {}", name, error.message()));
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

int plot(const PlotRequest& request) {
  const ImageFormat format = formatOf(request.format);
  SimulationPlan plan = planSimulation(request.run);
  const OutputFolder made(request.folder);
  const std::filesystem::path folder = request.folder;
  plan.stride = 1 + plan.steps / kMostSamples;
  Simulation simulation(plan);
  const std::int64_t samples = plan.steps / plan.stride;
  PlotHistoryWriter writer(simulation.twin(), plan.systems, 1 + samples / kEnsembleSamples);
  simulation.run(&writer, false);

  std::vector<std::unique_ptr<WaitingFile>> files;
  for (std::size_t i = 0; i < plan.systems.size(); ++i) {
    const BuiltSystem& system = *simulation.twin().systems()[plan.systems[i]];
    const Ensemble* const ensemble = simulation.twin().ensemble(plan.systems[i]);
    for (const SystemPlot& plot : systemPlots(system, ensemble, writer.histories()[i], format)) {
      const std::string name = fmt::format("{}_{}.{}", system.spec.name, plot.kind, request.format);
      files.push_back(std::make_unique<WaitingFile>((folder / name).string(), plot.image));
    }
  }
  for (const auto& file : files) {
    file->complete();
  }
  return simulation.sound() ? kDone : kFailed;
}

}  // namespace

void addPlotCommand(CLI::App& twin, int& status) {
  CLI::App* command = twin.add_subcommand("plot", kDescription);
  const auto request = std::make_shared<PlotRequest>();
  addSceneOption(command, request->run.scene);
  command->add_option("--system", request->run.system, "plot this system only")->type_name("NAME");
  command
      ->add_option(
          "--duration", request->run.duration,
          "s, simulated, to the nearest step; default: the longest drive profile, else 10 s")
      ->type_name("S");
  command
      ->add_option("--output", request->folder,
                   "folder of the files, made if need be; default: this one")
      ->type_name("FOLDER");
  command->add_option("--format", request->format, "svg or png; default: svg")->type_name("FORMAT");
  addInsistOption(command, request->run.insist);
  command->footer(kFooter);
  command->callback([request, &status] { status = plot(*request); });
}

}  // namespace whirl_twin

#include <fmt/format.h>

#include <filesystem>
#include <memory>
#include <optional>

#include "estimation/estimator_scene.h"
#include "estimation/follow_settings.h"
#include "reports/followed_log.h"
#include "requests/durations.h"
#include "requests/scene_argument.h"
#include "scene/yaml_file.h"
#include "tools/arguments.h"
#include "tools/commands.h"
#include "tools/progress_bar.h"
#include "tools/report_options.h"
#include "transport/channels.h"
#include "twin/scene_lines.h"

namespace whirl_twin {

namespace {

constexpr const char* kFollowDescription =
    "Estimates the state of a machine from the measurements in a log, a rosbag or a table, faster "
    "than\n"
    "real time: states that are not measured, and the parameters that --settings name; reports "
    "where\n"
    "machine and model diverge.";

constexpr const char* kFollowFooter =
    "The scene's sensors specify what is measured, where, and with how much noise. The result "
    "is\nbit-identical to that of follow_node. A value that does not exist, such as a drift, or "
    "the residual\nof a channel that was not used, is null in the JSON.\n"
    "\n"
    "Examples:\n"
    "  twin simulate rig.yaml --measure sensors --output rig.lcmlog && twin follow rig.yaml "
    "rig.lcmlog\n"
    "  twin follow rig.yaml monday.lcmlog --settings follow.yaml --output twin.lcmlog\n"
    "  twin follow rig.yaml monday.bag --lcm-prefix MACHINE_      topics of /machine, by rosbag "
    "record";

struct FollowRequest {
  SceneArgument scene;
  std::string log;
  std::optional<std::string> settings;
  std::optional<std::string> output;
  std::optional<std::string> sample;  // s
  std::string lcm_prefix = kDefaultLcmPrefix;
  std::optional<std::string> import;
  bool json = false;
  bool insist = false;
};

std::int64_t strideOf(const FollowRequest& request, const Scene& scene) {
  if (!request.sample) {
    return 1;
  }
  constexpr std::int64_t kLongest = 3'600'000'000'000;  // ns
  return parseNanoseconds("--sample", *request.sample, scene.step, kLongest, scene.step) /
         scene.step;
}

std::unique_ptr<SampleWriter> writerOf(const FollowRequest& request, const SceneTree& scene,
                                       const Twin& twin) {
  if (!request.output) {
    return nullptr;
  }
  std::vector<std::size_t> systems;
  for (std::size_t i = 0; i < twin.systems().size(); ++i) {
    systems.push_back(i);
  }
  const std::string extension = std::filesystem::path(*request.output).extension();
  if (extension == ".csv") {
    return makeTableWriter(twin, systems, *request.output);
  }
  if (extension == ".lcmlog") {
    return makeLogWriter(twin, systems, sceneText(scene.tree(), scene.absoluteSource()),
                         *request.output);
  }
  throw InputError(
      fmt::format("--output: must end in .csv or .lcmlog, found '{}'", *request.output));
}

int follow(const FollowRequest& request) {
  requireLcmPrefix(request.lcm_prefix);
  const SceneTree scene(request.scene);
  const Twin twin(scene.estimatorScene());
  const FollowSettings settings =
      request.settings
          ? readFollowSettings(
                readYamlFile(*request.settings, "settings of the state estimator", "systems"),
                *request.settings, twin.built())
          : FollowSettings{};
  const std::int64_t every = strideOf(request, twin.scene());
  const auto writer = writerOf(request, scene, twin);
  constexpr std::int64_t kParts = 1000;
  ProgressBar progress(request.log, kParts, false, request.insist);
  const FollowedLog run = followLog(
      twin, settings, {request.log, request.lcm_prefix, request.import}, writer.get(), every,
      [&](std::uint64_t bytes, std::uint64_t all) {
        progress.show(static_cast<std::int64_t>(
            static_cast<double>(kParts) * static_cast<double>(bytes) / static_cast<double>(all)));
      });
  progress.clear();
  if (writer) {
    writer->finish();
  }
  return printReport(request.json, json(run), text(run));
}

}  // namespace

void addFollowCommand(const ProgramCommand& twin, int& status) {
  const ProgramCommand command = twin.subcommand("follow", kFollowDescription);
  const auto request = std::make_shared<FollowRequest>();
  addSceneOption(command, request->scene);
  command
      .option("LOG", request->log,
              "LCM log, rosbag, table or UFF file with measurements: rig.lcmlog, rig.bag, rig.csv")
      .required()
      .type("");
  command
      .option("--settings", request->settings,
              "what to estimate beside the motion: parameters, unbalance, sensor offsets")
      .type("FILE");
  command.option("--output", request->output, "write the estimated motion, FILE.csv or FILE.lcmlog")
      .type("FILE");
  command
      .option("--sample", request->sample,
              "period of the samples written, to the nearest step; default: a step")
      .type("S");
  command
      .option("--lcm-prefix", request->lcm_prefix,
              "prefix of the machine's channels; default: TWIN_")
      .type("PREFIX");
  addImportOption(command, request->import);
  addJsonOption(command, request->json);
  addInsistOption(command, request->insist);
  command.takeUnits();
  command.footer(kFollowFooter);
  command.callback([request, &status] { status = follow(*request); });
}

}  // namespace whirl_twin

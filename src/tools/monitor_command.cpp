#include <algorithm>
#include <memory>
#include <optional>

#include "reports/asked_cost.h"
#include "reports/drawings.h"
#include "reports/monitored_log.h"
#include "tools/alarm_settings_file.h"
#include "tools/arguments.h"
#include "tools/commands.h"
#include "tools/progress_bar.h"
#include "tools/report_options.h"
#include "transport/channels.h"

namespace whirl_twin {

namespace {

constexpr const char* kMonitorDescription =
    "Replays a log, a rosbag or a table through the monitor, faster than real time: which alerts "
    "it\n"
    "raises and when, and the smallest margins; which resonances the run-ups passed, and "
    "the\ncomponents of the full spectrum.";

constexpr const char* kMonitorFooter =
    "The monitor's clock is that of the log's stamps; its limits are those of --settings, as those "
    "of\nmonitor_node are its parameters. Exit status: 0 replayed, with or without alerts; 2 a "
    "scene, a\nlog or settings that cannot be used.\n"
    "\n"
    "Examples:\n"
    "  twin simulate demo --output demo.lcmlog && twin monitor demo demo.lcmlog\n"
    "  twin monitor pump.yaml night.lcmlog --settings monitor.yaml --output night.html";

constexpr OptionQuantity kInstant{"a time", "s", -1.0e9, 1.0e9};

struct MonitorRequest {
  SceneArgument scene;
  std::string log;
  std::optional<std::string> settings;
  std::optional<std::string> output, csv;
  std::string lcm_prefix = kDefaultLcmPrefix;
  std::optional<std::string> import;
  std::optional<double> spectrum_at;  // s
  bool json = false;
  bool insist = false;
};

int monitor(const MonitorRequest& request) {
  requireCsvName(request.csv);
  requireLcmPrefix(request.lcm_prefix);
  const BuiltScene scene = build(sceneOf(request.scene));
  const AlarmSettings settings = alarmSettingsOf(scene, request.settings);
  AskedCost cost;  // for the speeds at the start
  for (const SharedSystem& system : scene.systems) {
    cost += costOfAnalysis(system->spec.name, system->dynamics->dof());
  }
  tell(cost, request.insist);
  constexpr std::int64_t kParts = 1000;
  ProgressBar progress(request.log, kParts, false, request.insist);
  const MonitoredLog run = monitorLog(
      scene, settings, {request.log, request.lcm_prefix, request.import}, request.spectrum_at,
      [&](std::uint64_t bytes, std::uint64_t all) {
        progress.show(
            static_cast<std::int64_t>(static_cast<double>(kParts) * static_cast<double>(bytes) /
                                      static_cast<double>(std::max<std::uint64_t>(1, all))));
      });
  progress.clear();
  if (request.output) {
    Drawings drawings;
    drawings.addPage(*request.output, page(run).json());
    drawings.write();
  }
  if (request.csv) {
    writeCsv(*request.csv, tables(run));
  }
  return printReport(request.json, json(run), text(run));
}

}  // namespace

void addMonitorCommand(const ProgramCommand& twin, int& status) {
  const ProgramCommand command = twin.subcommand("monitor", kMonitorDescription);
  const auto request = std::make_shared<MonitorRequest>();
  addSceneOption(command, request->scene);
  command
      .option("LOG", request->log,
              "LCM log, rosbag, or table of measurements: demo.lcmlog, night.bag, run.csv")
      .required()
      .type("");
  command
      .option("--settings", request->settings, "YAML like config/monitor.yaml; default: that file")
      .type("FILE");
  command.option("--output", request->output, "write the report as an HTML page, FILE.html")
      .type("FILE");
  command
      .option("--lcm-prefix", request->lcm_prefix,
              "prefix of the recorded twin's channels; default: TWIN_")
      .type("PREFIX");
  command
      .quantity("--spectrum-at", request->spectrum_at, kInstant,
                "end of the window of the full spectrum, simulated time", "the end of the log")
      .type("S");
  addImportOption(command, request->import);
  addCsvOption(command, request->csv);
  addJsonOption(command, request->json);
  addInsistOption(command, request->insist);
  command.footer(kMonitorFooter);
  command.callback([request, &status] { status = monitor(*request); });
}

}  // namespace whirl_twin

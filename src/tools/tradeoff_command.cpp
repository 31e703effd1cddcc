// `twin tradeoff`.
#include <fmt/format.h>

#include <cstdio>
#include <memory>
#include <optional>

#include "accuracy/trajectory.h"
#include "messages/input_error.h"
#include "reports/csv_table.h"
#include "reports/drawings.h"
#include "reports/rotor_systems.h"
#include "reports/tradeoff_report.h"
#include "requests/durations.h"
#include "tools/arguments.h"
#include "tools/commands.h"
#include "tools/progress_bar.h"
#include "tools/report_options.h"

namespace whirl_twin {

namespace {

constexpr const char* kTradeoffDescription =
    "Cost of every integrator on this machine and its error, at the scene's step, at multiples "
    "and\n"
    "at fractions of it.";

constexpr const char* kTradeoffFooter =
    "Errors are the largest over the duration against a reference run of known error: "
    "positions,\nwhirl radius and energy relative to their largest value, phase in rad.\n"
    "drift: of the energy balance. A setting is recommended only if every finer step of its "
    "method\n"
    "is within the tolerance as well. Costs are medians of seven interleaved rounds, with their "
    "range.\n"
    "\n"
    "Examples:\n"
    "  twin tradeoff demo --plot tradeoff.svg\n"
    "  twin tradeoff double_pendulum.yaml --system rods --duration 30 --json";

struct TradeoffRequest {
  SceneArgument scene;
  std::optional<std::string> system, duration, plot, output;
  bool json = false;
  bool insist = false;
};

void requireTableName(const std::optional<std::string>& path) {
  if (path && (path->size() < 5 || path->substr(path->size() - 4) != ".csv")) {
    throw InputError("--output: must end in .csv, found '" + *path + "'");
  }
}

constexpr std::int64_t kMaxHorizon = 1'000'000 * kSecond;  // ns

/// The horizon of the system, which must be a valid run duration. [ns]
std::int64_t horizonOf(const Scene& one) {
  const SystemSpec& spec = one.systems.front();
  const double horizon = 1.0e9 * spec.horizon;
  if (!(horizon >= static_cast<double>(one.step) && horizon <= static_cast<double>(kMaxHorizon))) {
    throw InputError(
        fmt::format("{}: the horizon, {:g} s, is outside the range of --duration; --duration: must "
                    "be from {} to {}",
                    spec.name, spec.horizon, inSeconds(one.step), inSeconds(kMaxHorizon)));
  }
  return static_cast<std::int64_t>(horizon);
}

int tradeoffOf(const TradeoffRequest& request) {
  requirePictureName(request.plot);
  requireTableName(request.output);
  const Scene scene = sceneOf(request.scene);
  const std::vector<std::size_t> systems = selectedSystems(scene, request.system);
  std::optional<std::int64_t> asked;  // [ns]
  if (request.duration) {
    asked = parseNanoseconds("--duration", *request.duration, scene.step, kMaxHorizon);
  }
  constexpr std::int64_t kParts = 1000;
  ProgressBar bar(fmt::format("--duration: {}", request.duration.value_or("the horizon")),
                  static_cast<std::int64_t>(systems.size()) * kParts, false, request.insist);
  std::vector<TradeoffReport> reports;
  for (std::size_t i = 0; i < systems.size(); ++i) {
    const Scene one = sceneOfOne(scene, systems[i]);
    const std::int64_t duration = asked ? *asked : horizonOf(one);
    reports.push_back(tradeoffReport(one, duration, [&](double share) {
      bar.show(static_cast<std::int64_t>(i) * kParts +
               static_cast<std::int64_t>(share * static_cast<double>(kParts)));
    }));
  }
  bar.clear();
  Drawings drawings;
  for (const TradeoffReport& report : reports) {
    if (request.plot) {
      drawings.add(pictureName(*request.plot, report.system, reports.size() > 1),
                   figureJson(figure(report)));
    }
  }
  drawings.write();
  if (request.output) {
    writeFile(*request.output, csv(reports));
  }
  Json all;
  std::string words;
  all["scene"] = scene.name;
  all["rows"] = Json::array();
  all["recommended"] = Json::array();
  for (const TradeoffReport& report : reports) {
    for (const TradeoffRow& row : report.rows) {
      all["rows"].push_back(rowJson(report, row));
    }
    all["recommended"].push_back(summaryJson(report));
    words += (words.empty() ? "" : "\n") + text(report);
  }
  return printReport(request.json, all, words);
}

}  // namespace

void addTradeoffCommand(const ProgramCommand& twin, int& status) {
  const ProgramCommand command = twin.subcommand("tradeoff", kTradeoffDescription);
  const auto request = std::make_shared<TradeoffRequest>();
  addSceneOption(command, request->scene);
  command.option("--system", request->system, "only this system").type("NAME");
  command
      .option("--duration", request->duration, "simulated time [s]; default: the system's horizon")
      .type("S");
  command.option("--plot", request->plot, "a work-precision plot, FILE.svg or FILE.png")
      .type("FILE");
  command.option("--output", request->output, "the rows as a table, FILE.csv").type("FILE");
  addJsonOption(command, request->json);
  addInsistOption(command, request->insist);
  command.takeUnits();
  command.footer(kTradeoffFooter);
  command.callback([request, &status] { status = tradeoffOf(*request); });
}

}  // namespace whirl_twin

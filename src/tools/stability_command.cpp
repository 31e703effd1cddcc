#include <memory>
#include <vector>

#include "requests/rotor_requests.h"
#include "tools/commands.h"
#include "tools/report_options.h"

namespace whirl_twin {

namespace {

constexpr const char* kStabilityDescription =
    "Stability level I of API 617: the logarithmic decrement of a rotor's slowest decaying forward "
    "whirl "
    "over\n"
    "a cross-coupled stiffness at mid-span, and the stiffness that API 617 expects of its stages.";

constexpr const char* kStabilityFooter =
    "kxy = Q, kyx = -Q at the station nearest to the middle between the outermost bearings, or\n"
    "--at another. A centrifugal stage has Q = 3 (P/w) / (D H) times the density ratio, an\n"
    "axial one 1.5 (P/w) / (D H); P its power, w the speed, D the impeller's diameter (the "
    "blades'\n"
    "pitch diameter), H the smallest discharge width (the blade height).\n"
    "\n"
    "Examples:\n"
    "  twin stability friswell_rotor --plot level_one.svg\n"
    "  twin stability friswell_rotor --stage 500 0.4 0.015 1.6 --stage 400 0.4 0.012 1.5";

struct StabilityOptions {
  ReportOptions options;
  LevelOneRequest level_one;
  std::vector<std::vector<double>> centrifugal, axial;
};

/// Each given stage, with its number of values.
void takeStages(StabilityOptions& request) {
  for (const std::vector<double>& s : request.centrifugal) {
    request.level_one.stages.push_back({s[0], s[1], s[2], s[3], false});
  }
  for (const std::vector<double>& s : request.axial) {
    request.level_one.stages.push_back({s[0], s[1], s[2], 1.0, true});
  }
}

}  // namespace

void addStabilityCommand(const ProgramCommand& twin, int& status) {
  const ProgramCommand command = twin.subcommand("stability", kStabilityDescription);
  const auto request = std::make_shared<StabilityOptions>();
  addReportOptions(command, request->options, "the diagram");
  command
      .option("--speed", request->level_one.speed,
              "speed of the shaft [rad/s]; default: the drive's highest")
      .type("W");
  command.option("--at", request->level_one.at, "station where it acts; default: at mid-span")
      .type("NAME");
  command
      .option("--stage", request->centrifugal,
              "W, m, m, -: power, diameter, width, density ratio of a centrifugal stage")
      .values(4)
      .type("P D H RATIO");
  command
      .option("--axial-stage", request->axial,
              "W, m, m: power, pitch diameter, blade height of an axial stage")
      .values(3)
      .type("P D H");
  command.footer(kStabilityFooter);
  command.callback([request, &status] {
    takeStages(*request);
    status = printDocument(
        stabilityDocument(sceneOf(request->options), request->options.system, request->level_one),
        request->options);
  });
}

}  // namespace whirl_twin

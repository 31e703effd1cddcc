#include <memory>

#include "requests/rotor_requests.h"
#include "tools/commands.h"
#include "tools/report_options.h"
#include "tools/stage_options.h"

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
    "  twin stability friswell_rotor --stage 500 0.4 0.015 1.6 --stage 400 0.4 0.012 1.5\n"
    "  twin stability friswell_rotor --stage \"0.5 kW\" \"400 mm\" \"15 mm\" 1.6";

struct StabilityOptions {
  ReportOptions options;
  LevelOneRequest level_one;
  StageOptions stages;
};

}  // namespace

void addStabilityCommand(const ProgramCommand& twin, int& status) {
  const ProgramCommand command = twin.subcommand("stability", kStabilityDescription);
  const auto request = std::make_shared<StabilityOptions>();
  addReportOptions(command, request->options, "the diagram");
  command
      .quantity("--speed", request->level_one.speed, kRunningSpeed, "speed of the shaft",
                "the drive's highest")
      .type("W");
  command.option("--at", request->level_one.at, "station where it acts; default: at mid-span")
      .type("NAME");
  addStageOptions(command, request->stages);
  command.footer(kStabilityFooter);
  command.callback([request, &status] {
    request->level_one.stages = request->stages.all();
    status =
        printDocument(stabilityDocument(sceneOf(request->options), request->options.system,
                                        request->level_one, chosenUnits(request->options.units)),
                      request->options);
  });
}

}  // namespace whirl_twin

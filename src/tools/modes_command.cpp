#include <memory>

#include "messages/input_error.h"
#include "requests/rotor_requests.h"
#include "tools/arguments.h"
#include "tools/commands.h"
#include "tools/report_options.h"

namespace whirl_twin {

namespace {

constexpr const char* kModesDescription =
    "Modes of the rotors of a scene at a speed: frequency, damping, direction, shape; and, from "
    "a\nlog of the running machine, those identified from its ambient vibration, with intervals.";

constexpr const char* kModesFooter =
    "LOG is an LCM log, a rosbag or a table with the measurements of the scene's `sensors`, "
    "displacement probes and a\n"
    "keyphasor, as `twin simulate --measure` writes them, or with the whirl that a twin "
    "published.\n"
    "The synchronous motion is removed; poles that persist over the model orders are modes. The\n"
    "speed is the one that was kept for longest. A decay rate s is known to sqrt(s/T) after T\n"
    "seconds at best.\n"
    "\n"
    "Examples:\n"
    "  twin modes balancing --speed 70 --plot modes.svg\n"
    "  twin modes balancing --measured run.lcmlog --json";

struct ModesOptions {
  ReportOptions options;
  ModesRequest request;
};

int showModes(ModesOptions& given) {
  if (given.options.plot && given.request.measured) {
    throw InputError(
        "--plot: draws the mode shapes of the model; must not be given with --measured");
  }
  given.request.system = given.options.system;
  return printDocument(
      modesDocument(sceneOf(given.options), given.request, chosenUnits(given.options.units)),
      given.options);
}

}  // namespace

void addModesCommand(const ProgramCommand& twin, int& status) {
  const ProgramCommand command = twin.subcommand("modes", kModesDescription);
  const auto given = std::make_shared<ModesOptions>();
  ModesRequest* const request = &given->request;
  addReportOptions(command, given->options, "the lowest mode shapes");
  command.option("--measured", request->measured, "log of the running machine").type("LOG");
  command
      .quantity("--speed", request->speed, kShaftSpeed, "speed of the shaft",
                "the drive's highest; of a log the one kept for longest")
      .type("W");
  command
      .quantity("--to", request->limit, kWhirlFrequency, "highest frequency searched",
                "slightly above the model's sixth")
      .type("W");
  command
      .option("--lcm-prefix", request->lcm_prefix, "prefix of the log's channels; default: TWIN_")
      .type("PREFIX");
  addImportOption(command, request->import);
  command.option("--modes", request->modes, "number of modes drawn; default: 6").type("N");
  command.footer(kModesFooter);
  command.callback([given, &status] { status = showModes(*given); });
}

}  // namespace whirl_twin

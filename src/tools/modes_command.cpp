#include <memory>
#include <optional>

#include "messages/input_error.h"
#include "reports/csv_table.h"
#include "reports/modes_report.h"
#include "reports/rotor_record.h"
#include "tools/commands.h"
#include "tools/report_options.h"

namespace whirl_twin {

namespace {

constexpr const char* kModesDescription =
    "Modes of the rotors of a scene at a speed: frequency, damping, direction, shape; and, from "
    "a\nlog of the running machine, those identified from its ambient vibration, with intervals.";

constexpr const char* kModesFooter =
    "LOG is an LCM log with the measurements of the scene's `sensors`, displacement probes and a\n"
    "keyphasor, as `twin simulate --measure` writes them, or with the whirl that a twin "
    "published.\n"
    "The synchronous motion is removed; poles that persist over the model orders are modes. The\n"
    "speed is the one that was kept for longest. A decay rate s is known to sqrt(s/T) after T\n"
    "seconds at best.\n"
    "\n"
    "Examples:\n"
    "  twin modes balancing --speed 70 --plot modes.svg\n"
    "  twin modes balancing --measured run.lcmlog --json";

struct ModesRequest {
  ReportOptions options;
  std::optional<std::string> measured;
  std::optional<double> speed, limit;
  int modes = 6;
  std::string lcm_prefix = kDefaultLcmPrefix;
};

void requireModesUse(const ModesRequest& request) {
  if (request.limit && !request.measured) {
    throw InputError("--to: needs --measured LOG");
  }
  if (request.options.plot && request.measured) {
    throw InputError(
        "--plot: draws the mode shapes of the model; must not be given with --measured");
  }
  if (request.modes < 1 || request.modes > 100) {
    throw InputError("--modes: expected from 1 to 100, found " + std::to_string(request.modes));
  }
  requireLcmPrefix(request.lcm_prefix);
}

int showModes(const ModesRequest& request) {
  requireModesUse(request);
  const BuiltScene scene = sceneOf(request.options);
  const auto rotors = rotorSystems(scene, request.options.system);
  if (request.measured && rotors.size() > 1) {
    throw InputError("--system: missing; must name the rotor that the log belongs to");
  }
  const auto report = [&](const RotorSystem& rotor) {
    return request.measured
               ? modesReport(rotor,
                             RotorRecord(scene, rotor, *request.measured, request.lcm_prefix,
                                         ProbesRead::kAtSameInstants),
                             request.speed, request.limit)
               : modesReport(rotor, request.speed.value_or(rotor.highest_speed));
  };
  return reportRotors(request.options, scene, rotors, report, [&](const ModesReport& modes) {
    return figure(modes, static_cast<std::size_t>(request.modes));
  });
}

}  // namespace

void addModesCommand(const ProgramCommand& twin, int& status) {
  const ProgramCommand command = twin.subcommand("modes", kModesDescription);
  const auto request = std::make_shared<ModesRequest>();
  addReportOptions(command, request->options, "the lowest mode shapes");
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
  command.option("--modes", request->modes, "number of modes drawn; default: 6").type("N");
  command.footer(kModesFooter);
  command.callback([request, &status] { status = showModes(*request); });
}

}  // namespace whirl_twin

// `twin response` and `twin orbit`.
#include <memory>

#include "requests/rotor_requests.h"
#include "tools/arguments.h"
#include "tools/commands.h"
#include "tools/report_options.h"

namespace whirl_twin {

namespace {

constexpr const char* kResponseFooter =
    "Speeds are added near peaks, so that none is missed between two points. The phase lag\n"
    "is that of the forward whirl behind the shaft's phase mark (parameter phase_mark, an angle "
    "of\nthe shaft, as the angles of its unbalances are). The picture: amplitude, phase, polar "
    "plot.\n"
    "\n"
    "With --force the rotor's unbalance is left out: a harmonic force of 1 N in a fixed direction "
    "acts\nat a station, over its frequency, the shaft at one speed. Printed are the displacement "
    "and velocity\nper newton, receptance and mobility, at the stations of --at. The full-order "
    "model of a shaft of\nelements is used, also if the simulation uses a reduced one.\n"
    "\n"
    "Examples:\n"
    "  twin response demo --to 120 --plot bode.svg\n"
    "  twin response demo --system rotor --station disc --csv response.csv\n"
    "  twin response friswell_rotor --force node_2 --at node_2 node_4 --speed 100 --plot frf.svg";

constexpr const char* kOrbitFooter =
    "In the picture a dot shows where each station is when the shaft's mark passes the x axis.\n"
    "\n"
    "Example:\n"
    "  twin orbit demo --speed 55 --plot orbit.svg";

struct ResponseOptions {
  ReportOptions options;
  ResponseRequest request;
  ForcedRequest force;
  double speed = 0.0;  // rad/s, of orbits
};

}  // namespace

void addResponseCommand(const ProgramCommand& twin, int& status) {
  const ProgramCommand command = twin.subcommand(
      "response", "Unbalance response of the rotors of a scene over the shaft's speed.");
  const auto given = std::make_shared<ResponseOptions>();
  ResponseRequest* const request = &given->request;
  ForcedRequest* const forced = &given->force;
  addReportOptions(command, given->options, "the picture");
  command.quantity("--from", request->range.from, kShaftSpeed, "lowest speed", "0").type("W");
  command
      .quantity("--to", request->range.to, kShaftSpeed, "highest speed",
                "1.2 times the drive's; of a force slightly above the sixth mode")
      .type("W");
  command.option("--points", request->range.points, "minimum number of speeds; default: 200")
      .type("N");
  command.option("--station", request->station, "only this station of the shaft").type("NAME");
  const Option force =
      command.option("--force", forced->force, "station of a harmonic force in a fixed direction")
          .type("NAME");
  command.option("--along", forced->along, "direction of the force, x or y; default: x")
      .needs(force)
      .type("AXIS");
  command.option("--at", forced->at, "stations of the response; default: that of the force")
      .needs(force)
      .type("NAME");
  command
      .quantity("--speed", forced->speed, kShaftSpeed, "speed of the shaft", "the drive's highest")
      .needs(force)
      .type("W");
  addInsistOption(command, request->insist);
  command.footer(kResponseFooter);
  command.callback([given, force, &status] {
    given->request.system = given->options.system;
    if (force.given()) {
      given->request.force = given->force;
    }
    status = printDocument(responseDocument(sceneOf(given->options), given->request,
                                            chosenUnits(given->options.units)),
                           given->options);
  });
}

void addOrbitCommand(const ProgramCommand& twin, int& status) {
  const ProgramCommand command =
      twin.subcommand("orbit", "Unbalance orbits at one speed, at every station of the rotors.");
  const auto given = std::make_shared<ResponseOptions>();
  addReportOptions(command, given->options, "the picture");
  command.quantity("--speed", given->speed, kShaftSpeed, "speed of the shaft").required().type("W");
  command.footer(kOrbitFooter);
  command.callback([given, &status] {
    status = printDocument(orbitDocument(sceneOf(given->options), given->options.system,
                                         given->speed, chosenUnits(given->options.units)),
                           given->options);
  });
}

}  // namespace whirl_twin

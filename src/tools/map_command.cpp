#include <memory>

#include "requests/rotor_requests.h"
#include "tools/commands.h"
#include "tools/report_options.h"

namespace whirl_twin {

namespace {

constexpr const char* kMapDescription =
    "Critical speed map: the undamped forward critical speeds of a flexible_rotor over the\n"
    "stiffness of its bearings, with the actual bearings marked.";

constexpr const char* kMapFooter =
    "Every bearing has the stiffness of the map in all directions, on rigid ground, without\n"
    "damping. Supports with less than a tenth of the highest stiffness, such as seals, are left "
    "out\n"
    "unless --bearing names their nodes.\n"
    "\n"
    "Examples:\n"
    "  twin map friswell_rotor --plot map.svg\n"
    "  twin map friswell_rotor --from 1e4 --to 1e10 --bearing 0 6 --json";

struct MapRequest {
  ReportOptions options;
  CriticalMapRequest map;
};

}  // namespace

void addMapCommand(const ProgramCommand& twin, int& status) {
  const ProgramCommand command = twin.subcommand("map", kMapDescription);
  const auto request = std::make_shared<MapRequest>();
  addReportOptions(command, request->options, "the map");
  constexpr OptionQuantity kStiffness{"a stiffness", "N/m", 0.0, kMaxMapStiffness, true};
  command
      .quantity("--from", request->map.from, kStiffness, "lowest stiffness",
                "a decade below the actual bearings")
      .type("K");
  command
      .quantity("--to", request->map.to, kStiffness, "highest stiffness",
                "two decades above the actual bearings")
      .type("K");
  command.option("--points", request->map.points, "number of stiffnesses; default: 61").type("N");
  command.option("--modes", request->map.modes, "number of lowest modes; default: 4").type("N");
  command.option("--bearing", request->map.nodes, "nodes whose bearings are varied").type("NODE");
  command.footer(kMapFooter);
  command.callback([request, &status] {
    status = printDocument(mapDocument(sceneOf(request->options), request->options.system,
                                       request->map, chosenUnits(request->options.units)),
                           request->options);
  });
}

}  // namespace whirl_twin

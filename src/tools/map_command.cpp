#include <memory>
#include <optional>

#include "reports/critical_map_report.h"
#include "reports/picture_file.h"
#include "scene/scene_reader.h"
#include "tools/arguments.h"
#include "tools/commands.h"
#include "tools/shipped_scenes.h"

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
  std::string scene;
  std::optional<std::string> system, plot, csv;
  CriticalMapRequest map;
  bool json = false;
};

int mapOf(const MapRequest& request) {
  requirePictureName(request.plot);
  requireCsvName(request.csv);
  const BuiltScene scene = build(readSceneFile(scenePath(request.scene)));
  const auto systems = rotorSystems(scene, request.system);
  Json all;
  all["scene"] = scene.scene.name;
  std::string words;
  CsvTables csv;
  for (const RotorSystem& system : systems) {
    const CriticalMapReport one = criticalMapReport(system, request.map);
    all["systems"][system.name] = json(one);
    append(csv, system.name, tables(one));
    words += (words.empty() ? "" : "\n") + text(one);
    if (request.plot) {
      writePicture(pictureName(*request.plot, system.name, systems.size() > 1), figure(one));
    }
  }
  if (request.csv) {
    writeCsv(*request.csv, csv);
  }
  if (request.json) {
    printJson(all);
  } else {
    printText(words);
  }
  return kDone;
}

}  // namespace

void addMapCommand(const ProgramCommand& twin, int& status) {
  const ProgramCommand command = twin.subcommand("map", kMapDescription);
  const auto request = std::make_shared<MapRequest>();
  addSceneOption(command, request->scene);
  command.option("--system", request->system, "only this rotor").type("NAME");
  command.option("--from", request->map.from, "N/m; default: a decade below the actual bearings")
      .type("K");
  command.option("--to", request->map.to, "N/m; default: two decades above the actual bearings")
      .type("K");
  command.option("--points", request->map.points, "number of stiffnesses; default: 61").type("N");
  command.option("--modes", request->map.modes, "number of lowest modes; default: 4").type("N");
  command.option("--bearing", request->map.nodes, "nodes whose bearings are varied").type("NODE");
  command.option("--plot", request->plot, "the map, FILE.svg or FILE.png").type("FILE");
  addCsvOption(command, request->csv);
  command.flag("--json", request->json, "print one JSON object");
  command.footer(kMapFooter);
  command.callback([request, &status] { status = mapOf(*request); });
}

}  // namespace whirl_twin

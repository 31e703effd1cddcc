#include <memory>
#include <optional>

#include "messages/refusal.h"
#include "reports/level_one_report.h"
#include "reports/picture_file.h"
#include "scene/scene_reader.h"
#include "tools/arguments.h"
#include "tools/commands.h"
#include "tools/shipped_scenes.h"

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

struct StabilityRequest {
  std::string scene;
  std::optional<std::string> system, plot, csv;
  LevelOneRequest level_one;
  std::vector<std::vector<double>> centrifugal, axial;
  bool json = false;
};

/// Each stage that was given, as many numbers as it takes.
void takeStages(StabilityRequest& request) {
  for (const std::vector<double>& s : request.centrifugal) {
    request.level_one.stages.push_back({s[0], s[1], s[2], s[3], false});
  }
  for (const std::vector<double>& s : request.axial) {
    request.level_one.stages.push_back({s[0], s[1], s[2], 1.0, true});
  }
}

int levelOneOf(StabilityRequest& request) {
  requirePictureName(request.plot);
  requireCsvName(request.csv);
  takeStages(request);
  const BuiltScene scene = build(readSceneFile(scenePath(request.scene)));
  const auto systems = rotorSystems(scene, request.system);
  Json all;
  all["scene"] = scene.scene.name;
  std::string words;
  CsvTables csv;
  for (const RotorSystem& system : systems) {
    const LevelOneReport one = levelOneReport(system, request.level_one);
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

void addStabilityCommand(const ProgramCommand& twin, int& status) {
  const ProgramCommand command = twin.subcommand("stability", kStabilityDescription);
  const auto request = std::make_shared<StabilityRequest>();
  addSceneOption(command, request->scene);
  command.option("--system", request->system, "only this rotor").type("NAME");
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
  command.option("--plot", request->plot, "the diagram, FILE.svg or FILE.png").type("FILE");
  addCsvOption(command, request->csv);
  command.flag("--json", request->json, "print one JSON object");
  command.footer(kStabilityFooter);
  command.callback([request, &status] { status = levelOneOf(*request); });
}

}  // namespace whirl_twin

#include <cstdint>
#include <memory>
#include <optional>

#include "messages/refusal.h"
#include "reports/asked_cost.h"
#include "reports/campbell_report.h"
#include "reports/picture_file.h"
#include "reports/rotor_systems.h"
#include "scene/scene_reader.h"
#include "tools/arguments.h"
#include "tools/commands.h"
#include "tools/progress_bar.h"
#include "tools/shipped_scenes.h"

namespace whirl_twin {

namespace {

constexpr const char* kCampbellDescription =
    "Whirl frequencies of the rotors of a scene over the shaft's speed, their directions and\n"
    "damping, and the critical speeds where they meet it.";

constexpr const char* kCampbellFooter =
    "Modes are tracked by their shapes through every crossing. Directions: forward, backward,\n"
    "mixed where stations along the shaft disagree, straight where the whirl is in a plane.\n"
    "In the picture: dashed where a mode is unstable, rings at critical speeds, bands where API "
    "617\nallows no running speed.\n"
    "\n"
    "Examples:\n"
    "  twin campbell demo --to 120 --plot campbell.svg\n"
    "  twin campbell demo --system rotor --harmonic 1 2 --csv campbell.csv";

struct CampbellCommandRequest {
  std::string scene;
  std::optional<std::string> system, plot, csv;
  SpeedRangeOptions range;
  std::vector<double> harmonics{1.0};
  int modes = 12;
  bool json = false;
  bool insist = false;
};

void requireNumbers(const CampbellCommandRequest& request) {
  for (const double harmonic : request.harmonics) {
    if (!(harmonic > 0.0 && harmonic <= 100.0)) {
      throw Refusal("--harmonic: expected multiples of the speed above 0 and up to 100, found " +
                    std::to_string(harmonic));
    }
  }
  if (request.modes < 1 || request.modes > 1000) {
    throw Refusal("--modes: expected from 1 to 1000, found " + std::to_string(request.modes));
  }
}

int campbellOf(const CampbellCommandRequest& request) {
  requirePictureName(request.plot);
  requireCsvName(request.csv);
  requireNumbers(request);
  const BuiltScene scene = build(readSceneFile(scenePath(request.scene)));
  const auto systems = rotorSystems(scene, request.system);
  AskedCost cost;
  for (const RotorSystem& system : systems) {
    cost += costOfCampbell(system.name, system.dynamics->dof(), request.range.points);
  }
  tell(cost, request.insist);
  Json all;
  all["scene"] = scene.scene.name;
  std::string report;
  CsvTables csv;
  ProgressBar bar(cost.cause, static_cast<std::int64_t>(systems.size()) * request.range.points,
                  false, request.insist);
  std::int64_t before = 0;  // speeds of the systems that are done
  for (const RotorSystem& system : systems) {
    const CampbellReport one = campbellReport(
        system, request.range.of(system), request.harmonics,
        static_cast<std::size_t>(request.modes),
        [&](std::size_t done) { bar.show(before + static_cast<std::int64_t>(done)); });
    before += request.range.points;
    all["systems"][system.name] = json(one);
    append(csv, system.name, tables(one));
    report += (report.empty() ? "" : "\n") + text(one);
    if (request.plot) {
      writePicture(pictureName(*request.plot, system.name, systems.size() > 1), figure(one));
    }
  }
  bar.clear();
  if (request.csv) {
    writeCsv(*request.csv, csv);
  }
  if (request.json) {
    printJson(all);
  } else {
    printText(report);
  }
  return kDone;
}

}  // namespace

void addCampbellCommand(const ProgramCommand& twin, int& status) {
  const ProgramCommand command = twin.subcommand("campbell", kCampbellDescription);
  const auto request = std::make_shared<CampbellCommandRequest>();
  addSceneOption(command, request->scene);
  command.option("--system", request->system, "only this rotor").type("NAME");
  command.option("--from", request->range.from, "rad/s; default: 0").type("W");
  command.option("--to", request->range.to, "rad/s; default: 1.2 times the drive's highest speed")
      .type("W");
  command.option("--points", request->range.points, "number of speeds; default: 200").type("N");
  command.option("--harmonic", request->harmonics, "multiples of the speed; default: 1").type("H");
  command.option("--modes", request->modes, "number of lowest modes; default: 12").type("N");
  command.option("--plot", request->plot, "the diagram, FILE.svg or FILE.png").type("FILE");
  addCsvOption(command, request->csv);
  command.flag("--json", request->json, "print one JSON object");
  addInsistOption(command, request->insist);
  command.footer(kCampbellFooter);
  command.callback([request, &status] { status = campbellOf(*request); });
}

}  // namespace whirl_twin

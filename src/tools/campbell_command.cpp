#include <memory>

#include "requests/rotor_requests.h"
#include "tools/arguments.h"
#include "tools/commands.h"
#include "tools/progress_bar.h"
#include "tools/report_options.h"

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

struct CampbellOptions {
  ReportOptions options;
  CampbellReportRequest request;
};

int campbellOf(CampbellOptions& given) {
  given.request.system = given.options.system;
  const Scene scene = sceneOf(given.options);
  TerminalProgress progress(false);
  return printDocument(
      campbellDocument(scene, given.request, progress, chosenUnits(given.options.units)),
      given.options);
}

}  // namespace

void addCampbellCommand(const ProgramCommand& twin, int& status) {
  const ProgramCommand command = twin.subcommand("campbell", kCampbellDescription);
  const auto given = std::make_shared<CampbellOptions>();
  CampbellReportRequest* const request = &given->request;
  addReportOptions(command, given->options, "the diagram");
  command.quantity("--from", request->range.from, kShaftSpeed, "lowest speed", "0").type("W");
  command.quantity("--to", request->range.to, kShaftSpeed, "highest speed", "1.2 times the drive's")
      .type("W");
  command.option("--points", request->range.points, "number of speeds; default: 200").type("N");
  command.option("--harmonic", request->harmonics, "multiples of the speed; default: 1").type("H");
  command.option("--modes", request->modes, "number of lowest modes; default: 12").type("N");
  addInsistOption(command, request->insist);
  command.footer(kCampbellFooter);
  command.callback([given, &status] { status = campbellOf(*given); });
}

}  // namespace whirl_twin

#include <cstdint>
#include <memory>
#include <optional>

#include "messages/input_error.h"
#include "reports/asked_cost.h"
#include "reports/campbell_report.h"
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

struct CampbellCommandRequest {
  ReportOptions options;
  SpeedRangeOptions range;
  std::vector<double> harmonics{1.0};
  int modes = 12;
  bool insist = false;
};

void requireNumbers(const CampbellCommandRequest& request) {
  for (const double harmonic : request.harmonics) {
    if (!(harmonic > 0.0 && harmonic <= 100.0)) {
      throw InputError("--harmonic: expected multiples of the speed above 0 and up to 100, found " +
                       std::to_string(harmonic));
    }
  }
  if (request.modes < 1 || request.modes > 1000) {
    throw InputError("--modes: expected from 1 to 1000, found " + std::to_string(request.modes));
  }
}

int campbellOf(const CampbellCommandRequest& request) {
  requireNumbers(request);
  const BuiltScene scene = sceneOf(request.options);
  const auto rotors = rotorSystems(scene, request.options.system);
  AskedCost cost;
  for (const RotorSystem& rotor : rotors) {
    cost += costOfCampbell(rotor.name, rotor.dynamics->dof(), request.range.points);
  }
  tell(cost, request.insist);
  ProgressBar bar(cost.cause, static_cast<std::int64_t>(rotors.size()) * request.range.points,
                  false, request.insist);
  std::int64_t before = 0;  // speeds of the rotors that are done
  const auto report = [&](const RotorSystem& rotor) {
    CampbellReport one = campbellReport(
        rotor, request.range.of(rotor), request.harmonics, static_cast<std::size_t>(request.modes),
        [&](std::size_t done) { bar.show(before + static_cast<std::int64_t>(done)); });
    before += request.range.points;
    if (before == static_cast<std::int64_t>(rotors.size()) * request.range.points) {
      bar.clear();
    }
    return one;
  };
  return reportRotors(request.options, scene, rotors, report,
                      [](const CampbellReport& one) { return figure(one); });
}

}  // namespace

void addCampbellCommand(const ProgramCommand& twin, int& status) {
  const ProgramCommand command = twin.subcommand("campbell", kCampbellDescription);
  const auto request = std::make_shared<CampbellCommandRequest>();
  addReportOptions(command, request->options, "the diagram");
  command.quantity("--from", request->range.from, kShaftSpeed, "lowest speed", "0").type("W");
  command.quantity("--to", request->range.to, kShaftSpeed, "highest speed", "1.2 times the drive's")
      .type("W");
  command.option("--points", request->range.points, "number of speeds; default: 200").type("N");
  command.option("--harmonic", request->harmonics, "multiples of the speed; default: 1").type("H");
  command.option("--modes", request->modes, "number of lowest modes; default: 12").type("N");
  addInsistOption(command, request->insist);
  command.footer(kCampbellFooter);
  command.callback([request, &status] { status = campbellOf(*request); });
}

}  // namespace whirl_twin

#include <fmt/format.h>

#include <filesystem>
#include <memory>
#include <optional>
#include <vector>

#include "messages/input_error.h"
#include "reports/rotor_report.h"
#include "scene/scene_reader.h"
#include "tools/arguments.h"
#include "tools/commands.h"
#include "requests/shipped_scenes.h"

namespace whirl_twin {

namespace {

constexpr const char* kReportDescription =
    "Reports on the rotors of a scene: one HTML page each, with its pictures inside, that opens\n"
    "without a network and can be printed.";

constexpr const char* kReportFooter =
    "For a flexible_rotor: drawing and tables of its parts, mass, sag, bearing loads, shear force\n"
    "and bending moment, critical speed map. For every linear rotor: whirl modes, Campbell "
    "diagram,\n"
    "unbalance response with amplification factors and separation margins, stability level I. "
    "Each\npage lists at its end what is left out. The pages are FOLDER/SYSTEM.html.\n"
    "\n"
    "Examples:\n"
    "  twin report friswell_rotor --output pages\n"
    "  twin report friswell_rotor --output pages --stage 500 0.4 0.015 1.6";

struct ReportRequest {
  std::string scene, output;
  std::optional<std::string> system;
  RotorReportRequest report;
  std::vector<std::vector<double>> centrifugal, axial;
};

void makeFolder(const std::string& name) {
  std::error_code error;
  std::filesystem::create_directories(name, error);
  if (!std::filesystem::is_directory(name)) {
    throw RunFailure(fmt::format("--output: must be a folder, found '{}'", name));
  }
}

int reportOf(ReportRequest& request) {
  for (const std::vector<double>& s : request.centrifugal) {
    request.report.stages.push_back({s[0], s[1], s[2], s[3], false});
  }
  for (const std::vector<double>& s : request.axial) {
    request.report.stages.push_back({s[0], s[1], s[2], 1.0, true});
  }
  const BuiltScene scene = build(readSceneFile(scenePath(request.scene)));
  const auto systems = rotorSystems(scene, request.system);
  std::vector<std::string> pages;
  for (const RotorSystem& system : systems) {
    pages.push_back(rotorReportPage(scene, system, request.report));
  }
  makeFolder(request.output);
  for (std::size_t i = 0; i < systems.size(); ++i) {
    const std::filesystem::path path =
        std::filesystem::path(request.output) / (systems[i].name + ".html");
    writeFile(path.string(), pages[i]);
    printText(path.string() + "\n");
  }
  return kDone;
}

}  // namespace

void addReportCommand(const ProgramCommand& twin, int& status) {
  const ProgramCommand command = twin.subcommand("report", kReportDescription);
  const auto request = std::make_shared<ReportRequest>();
  addSceneOption(command, request->scene);
  command.option("--output", request->output, "folder of the pages, created if missing")
      .required()
      .type("FOLDER");
  command.option("--system", request->system, "only this rotor").type("NAME");
  command
      .option("--speed", request->report.speed,
              "speed [rad/s] of modes, margins and stability; default: the drive's highest")
      .type("W");
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
  command.footer(kReportFooter);
  command.callback([request, &status] { status = reportOf(*request); });
}

}  // namespace whirl_twin

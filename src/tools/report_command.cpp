#include <fmt/chrono.h>
#include <fmt/format.h>

#include <algorithm>
#include <ctime>
#include <filesystem>
#include <memory>
#include <optional>
#include <vector>

#include "messages/input_error.h"
#include "reports/drawings.h"
#include "reports/rotor_report.h"
#include "tools/arguments.h"
#include "tools/commands.h"
#include "tools/report_options.h"
#include "tools/stage_options.h"

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
    "Each\npage lists at its end what is left out. The pages are\nFOLDER/SCENE_SYSTEM.html.\n"
    "\n"
    "Examples:\n"
    "  twin report friswell_rotor --output pages\n"
    "  twin report friswell_rotor --output pages --stage 500 0.4 0.015 1.6";

struct ReportRequest {
  SceneArgument scene;
  std::string output;
  std::optional<std::string> system, units;
  RotorReportRequest report;
  StageOptions stages;
};

void makeFolder(const std::string& name) {
  std::error_code error;
  std::filesystem::create_directories(name, error);
  if (!std::filesystem::is_directory(name)) {
    throw RunFailure(fmt::format("--output: must be a folder, found '{}'", name));
  }
}

/// 2026-11-28
std::string today() {
  return fmt::format("{:%Y-%m-%d}", fmt::localtime(std::time(nullptr)));
}

/// SCENE_SYSTEM.html: a folder may hold the pages of several scenes. A slash of a name would be a
/// folder.
std::string pageName(const std::string& scene, const std::string& system) {
  std::string page = scene == system ? system : scene + "_" + system;
  std::replace(page.begin(), page.end(), '/', '_');
  return page + ".html";
}

int reportOf(ReportRequest& request) {
  request.report.stages = request.stages.all();
  request.report.units = chosenUnits(request.units);
  const BuiltScene scene = build(sceneOf(request.scene));
  const auto systems = rotorSystems(scene, request.system);
  std::vector<ReportPage> pages;
  for (const RotorSystem& system : systems) {
    pages.push_back(rotorReportPage(scene, system, request.report));
    pages.back().fact("scene", scene.scene.source);
    pages.back().fact("date", today());
    pages.back().fact("version", "whirl_twin " WHIRL_TWIN_VERSION);
  }
  makeFolder(request.output);
  Drawings drawings;
  for (std::size_t i = 0; i < systems.size(); ++i) {
    const std::filesystem::path folder = request.output;
    drawings.addPage((folder / pageName(scene.scene.name, systems[i].name)).string(),
                     pages[i].json());
  }
  printText(joined(drawings.write(), [](const std::string& path) { return path + "\n"; }));
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
      .quantity("--speed", request->report.speed, kRunningSpeed,
                "speed of modes, margins and stability", "the drive's highest")
      .type("W");
  addStageOptions(command, request->stages);
  addUnitsOption(command, request->units);
  command.footer(kReportFooter);
  command.callback([request, &status] { status = reportOf(*request); });
}

}  // namespace whirl_twin

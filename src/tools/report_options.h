// What the commands that report on a scene share: options, and where a report goes (text, JSON, CSV
// tables, picture).
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "reports/csv_table.h"
#include "reports/drawings.h"
#include "reports/output.h"
#include "reports/rotor_systems.h"
#include "reports/shown_units.h"
#include "scene/built_scene.h"
#include "tools/command.h"
#include "tools/scene_argument.h"

namespace whirl_twin {

struct ReportOptions {
  SceneArgument scene;
  std::optional<std::string> system, plot, csv, units;
  bool json = false;
};

/// SCENE, --set, --system, --plot (`drawn`: what it draws), --csv, --json, --units.
void addReportOptions(const ProgramCommand& command, ReportOptions& options,
                      const std::string& drawn);
/// --units alone.
void addUnitsOption(const ProgramCommand& command, std::optional<std::string>& units);
/// --json alone.
void addJsonOption(const ProgramCommand& command, bool& json);

/// Prints one JSON object, or the text. Returns kDone. Throws RunFailure.
int printReport(bool as_json, const Json& json, const std::string& text);
/// The same, after the tables are written if a file is named.
int printReport(const ReportOptions& options, const Json& json, const std::string& text,
                const CsvTables& tables);

/// Reads and builds the scene. Throws InputError, also for names of files that cannot be written.
BuiltScene sceneOf(const ReportOptions& options);

/// `make` gives the report of a rotor that json(), text() and tables() take, `draw` its picture.
template <class Make, class Draw>
int reportRotors(const ReportOptions& options, const BuiltScene& scene,
                 const std::vector<RotorSystem>& rotors, const Make& make, const Draw& draw) {
  Json all;
  all["scene"] = scene.scene.name;
  const ShownUnits units = chosenUnits(options.units);
  std::string words;
  CsvTables csv;
  Drawings drawings;
  for (const RotorSystem& rotor : rotors) {
    const auto report = make(rotor);
    all["systems"][rotor.name] = json(report);
    append(csv, rotor.name, tables(report));
    words += (words.empty() ? "" : "\n") + text(report, units);
    if (options.plot) {
      drawings.add(pictureName(*options.plot, rotor.name, rotors.size() > 1),
                   figureJson(draw(report)));
    }
  }
  drawings.write();
  return printReport(options, all, words, csv);
}

/// Of all rotors of the scene, or of the one that --system names.
template <class Make>
int reportRotors(const ReportOptions& options, const Make& make) {
  const BuiltScene scene = sceneOf(options);
  return reportRotors(options, scene, rotorSystems(scene, options.system), make,
                      [](const auto& report) { return figure(report); });
}

}  // namespace whirl_twin

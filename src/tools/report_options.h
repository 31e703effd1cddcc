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
#include "scene/built_scene.h"
#include "tools/command.h"

namespace whirl_twin {

struct ReportOptions {
  std::string scene;
  std::optional<std::string> system, plot, csv;
  bool json = false;
};

/// SCENE, --system, --plot (`drawn`: what it draws), --csv, --json.
void addReportOptions(const ProgramCommand& command, ReportOptions& options,
                      const std::string& drawn);
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
  std::string words;
  CsvTables csv;
  Drawings drawings;
  for (const RotorSystem& rotor : rotors) {
    const auto report = make(rotor);
    all["systems"][rotor.name] = json(report);
    append(csv, rotor.name, tables(report));
    words += (words.empty() ? "" : "\n") + text(report);
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

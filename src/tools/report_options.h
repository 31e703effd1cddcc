// What the commands that report on a scene share: options, and where a report goes (text, JSON, CSV
// tables, picture).
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "reports/csv_table.h"
#include "reports/drawings.h"
#include "reports/output.h"
#include "reports/shown_units.h"
#include "requests/document.h"
#include "requests/scene_argument.h"
#include "scene/scene.h"
#include "tools/command.h"

namespace whirl_twin {

struct ReportOptions {
  SceneArgument scene;
  std::optional<std::string> system, plot, csv, units;
  bool json = false;
};

/// SCENE, --set, --system, --plot (`drawn`: what it draws), --csv, --units, --json.
void addReportOptions(const ProgramCommand& command, ReportOptions& options,
                      const std::string& drawn);
/// --units alone.
void addUnitsOption(const ProgramCommand& command, std::optional<std::string>& units);
/// --json alone.
void addJsonOption(const ProgramCommand& command, bool& json);

/// Prints one JSON object, or the text. Returns kDone. Throws RunFailure.
int printReport(bool as_json, const Json& json, const std::string& text);
/// Writes the tables and the figures for which a file is named, then prints the document. Returns
/// the exit status. Throws RunFailure.
int printDocument(const Document& document, bool as_json, const std::optional<std::string>& csv,
                  const std::optional<std::string>& plot = std::nullopt);
int printDocument(const Document& document, const ReportOptions& options);

/// Reads the scene. Throws InputError, also for names of files that cannot be written.
Scene sceneOf(const ReportOptions& options);

}  // namespace whirl_twin

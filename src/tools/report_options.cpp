#include "tools/report_options.h"

#include "tools/arguments.h"
#include "tools/commands.h"

namespace whirl_twin {

void addReportOptions(const ProgramCommand& command, ReportOptions& options,
                      const std::string& drawn) {
  addSceneOption(command, options.scene);
  command.option("--system", options.system, "only this rotor").type("NAME");
  command.option("--plot", options.plot, drawn + ", FILE.svg, .png, .pdf or .json").type("FILE");
  addCsvOption(command, options.csv);
  addUnitsOption(command, options.units);
  addJsonOption(command, options.json);
}

void addUnitsOption(const ProgramCommand& command, std::optional<std::string>& units) {
  command
      .option("--units", units,
              "units of text and figures, such as \"rpm, mil pp, deg\"; default: those of the file "
              "~/.config/whirl_twin/units, else SI; JSON and CSV are always in SI")
      .type("LIST");
}

void addJsonOption(const ProgramCommand& command, bool& json) {
  command.flag("--json", json, "print one JSON object");
}

int printReport(bool as_json, const Json& json, const std::string& text) {
  if (as_json) {
    printJson(json);
  } else {
    printText(text);
  }
  return kDone;
}

int printDocument(const Document& document, bool as_json, const std::optional<std::string>& csv,
                  const std::optional<std::string>& plot) {
  if (csv) {
    writeCsv(*csv, document.tables);
  }
  Drawings files;
  for (const Drawing& drawing : plot ? document.drawings : std::vector<Drawing>{}) {
    files.add(pictureName(*plot, drawing.name, document.drawings.size() > 1), drawing.draw());
  }
  files.write();
  printReport(as_json, document.json, document.text);
  if (!document.failure.empty()) {  // for users who do not read the report
    complain("twin: " + document.failure + "\n");
  }
  return document.done ? kDone : kFailed;
}

int printDocument(const Document& document, const ReportOptions& options) {
  return printDocument(document, options.json, options.csv, options.plot);
}

Scene sceneOf(const ReportOptions& options) {
  requirePictureName(options.plot);
  requireCsvName(options.csv);
  return sceneOf(options.scene);
}

}  // namespace whirl_twin

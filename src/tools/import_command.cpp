// `twin import`.
#include <fmt/format.h>

#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "estimation/table_import.h"
#include "reports/output.h"
#include "reports/rotor_drawing.h"
#include "requests/scene_argument.h"
#include "scene/scene_reader.h"
#include "scene/yaml_file.h"
#include "tools/commands.h"
#include "tools/progress_bar.h"
#include "transport/lcm_event_log.h"

namespace whirl_twin {

namespace {

constexpr const char* kImportDescription =
    "Writes the scene of a rotor saved by another program, or a log of the measurements in tables, "
    "and\nreports what it leaves out.";

constexpr const char* kImportFooter =
    "FORMAT is ross (a .toml or .json of ROSS's Rotor.save()), csv (a table of shaft elements:\n"
    "length, outer_diameter, inner_diameter ..., each followed by its unit if not SI) or "
    "measurements\n"
    "(tables and UFF files of a machine, whose columns are the channels of a scene's sensors).\n"
    "Measurements need no import to be evaluated: follow, monitor, balance, modes and fit read "
    "the\n"
    "tables themselves. The settings, all optional:\n"
    "  separator: \";\"                          or , tab blank; likewise decimal: \",\"  comment: "
    "\"#\"\n"
    "  skip: 3                                 lines before the names; names: [t, x, y]\n"
    "  time: {column: t, unit: ms}             or rate: 25.6 kHz, of rows without a time\n"
    "  columns:                                of channels with another name, and of volts\n"
    "    x: {column: CH1, scale: 200 mV/mil, gap: -10 V}\n"
    "  keyphasor: {column: CH3, threshold: -5 V, slope: falling, hysteresis: 1 V}\n"
    "\n"
    "Examples:\n"
    "  twin import ross compressor.toml > compressor.yaml\n"
    "  twin import csv elements.csv --output shaft.yaml         with a line `length "
    "(mm),outer_diameter (mm)`\n"
    "                                                           and one for each element\n"
    "  twin import measurements run.csv --scene rig.yaml --settings import.yaml --output "
    "run.lcmlog";

struct ImportRequest {
  std::string format;
  std::vector<std::string> files;
  std::optional<std::string> output, settings;
  SceneArgument scene;
};

int importRotor(const ImportRequest& request) {
  if (request.files.size() != 1) {
    throw InputError(fmt::format("FILE: must be one file, found {}", request.files.size()));
  }
  const std::string& file = request.files.front();
  const RotorDrawing drawing =
      request.format == "ross" ? drawingOfRoss(file) : drawingOfElements(file);
  const std::string text = sceneText(drawing);
  static_cast<void>(readScene(readYamlText(text, file, "a rotor", "elements"), file));
  for (const std::string& line : drawing.left_out) {
    complain(fmt::format("{}: not carried over: {}\n", file, line));
  }
  if (!request.output) {
    printText(text);
    return kDone;
  }
  writeFile(*request.output, text);
  return kDone;
}

/// A table, and its messages that are not yet written.
struct ImportedTable {
  TableImport table;
  std::vector<state::Measurement> next;
};

/// The messages of all tables in the order of time.
int importMeasurements(const ImportRequest& request) {
  if (request.scene.name.empty() || !request.output ||
      std::filesystem::path(*request.output).extension() != ".lcmlog") {
    throw InputError("measurements: need --scene SCENE and --output FILE.lcmlog");
  }
  const Scene scene = sceneOf(request.scene);
  const ImportSettings settings =
      request.settings ? readImportSettings(*request.settings) : ImportSettings();
  std::vector<ImportedTable> tables;
  std::uint64_t size = 1, offset = 0;
  for (const std::string& file : request.files) {
    tables.push_back({TableImport(file, settings, estimatorSources(scene, {})), {}});
    tables.back().next = tables.back().table.next();
    size += tables.back().table.size();
  }
  PendingFile pending(*request.output);
  EventLogWriter log(pending.path());
  ProgressBar progress(request.files.front(), static_cast<std::int64_t>(size), false, true);
  while (true) {
    ImportedTable* first = nullptr;
    offset = 0;
    for (ImportedTable& table : tables) {
      offset += table.table.offset();
      if (!table.next.empty() &&
          (first == nullptr || table.next.front().at.time < first->next.front().at.time)) {
        first = &table;
      }
    }
    if (first == nullptr) {
      break;
    }
    for (const state::Measurement& message : first->next) {
      log.write(message);
    }
    progress.show(static_cast<std::int64_t>(offset));
    first->next = first->table.next();
  }
  progress.clear();
  log.finish();
  pending.complete();
  for (std::size_t i = 0; i < tables.size(); ++i) {
    for (const std::string& remark : tables[i].table.remarks()) {
      complain(fmt::format("{}: {}\n", request.files[i], remark));
    }
  }
  return kDone;
}

}  // namespace

void addImportCommand(const ProgramCommand& twin, int& status) {
  const ProgramCommand command = twin.subcommand("import", kImportDescription);
  const auto request = std::make_shared<ImportRequest>();
  command.option("FORMAT", request->format, "ross, csv or measurements")
      .required()
      .among({"ross", "csv", "measurements"})
      .type("");
  command.option("FILE", request->files, "the file of the other program; of measurements several")
      .required()
      .type("");
  command.option("--output", request->output, "the scene's file, FILE.yaml; the log, FILE.lcmlog")
      .type("FILE");
  command.option("--scene", request->scene.name, "of measurements: whose sensors they are")
      .type("SCENE");
  command.option("--settings", request->settings, "of measurements: how the tables are read, YAML")
      .type("FILE");
  command.footer(kImportFooter);
  command.callback([request, &status] {
    status =
        request->format == "measurements" ? importMeasurements(*request) : importRotor(*request);
  });
}

}  // namespace whirl_twin

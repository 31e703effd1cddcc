// `twin import`.
#include <fmt/format.h>

#include <memory>
#include <optional>
#include <string>

#include "reports/output.h"
#include "reports/rotor_drawing.h"
#include "scene/scene_reader.h"
#include "scene/yaml_file.h"
#include "tools/commands.h"

namespace whirl_twin {

namespace {

constexpr const char* kImportDescription =
    "Writes the scene of a rotor saved by another program, and reports what it leaves out.";

constexpr const char* kImportFooter =
    "FORMAT is ross (a .toml or .json of ROSS's Rotor.save()) or csv (a table of shaft elements:\n"
    "length, outer_diameter, inner_diameter ..., each followed by its unit if not SI).\n"
    "\n"
    "Examples:\n"
    "  twin import ross compressor.toml > compressor.yaml\n"
    "  twin import csv elements.csv --output shaft.yaml         with a line `length "
    "(mm),outer_diameter (mm)`\n"
    "                                                           and one for each element";

struct ImportRequest {
  std::string format;
  std::string file;
  std::optional<std::string> output;
};

int importRotor(const ImportRequest& request) {
  const RotorDrawing drawing =
      request.format == "ross" ? drawingOfRoss(request.file) : drawingOfElements(request.file);
  const std::string text = sceneText(drawing);
  static_cast<void>(
      readScene(readYamlText(text, request.file, "a rotor", "elements"), request.file));
  for (const std::string& line : drawing.left_out) {
    complain(fmt::format("{}: not carried over: {}\n", request.file, line));
  }
  if (!request.output) {
    printText(text);
    return kDone;
  }
  writeFile(*request.output, text);
  return kDone;
}

}  // namespace

void addImportCommand(const ProgramCommand& twin, int& status) {
  const ProgramCommand command = twin.subcommand("import", kImportDescription);
  const auto request = std::make_shared<ImportRequest>();
  command.option("FORMAT", request->format, "ross or csv")
      .required()
      .among({"ross", "csv"})
      .type("");
  command.option("FILE", request->file, "the file of the other program").required().type("");
  command.option("--output", request->output, "the scene's file").type("FILE.yaml");
  command.footer(kImportFooter);
  command.callback([request, &status] { status = importRotor(*request); });
}

}  // namespace whirl_twin

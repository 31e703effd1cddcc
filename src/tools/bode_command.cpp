// `twin bode`.
#include <memory>
#include <optional>

#include "reports/bode_report.h"
#include "tools/arguments.h"
#include "tools/commands.h"
#include "tools/report_options.h"

namespace whirl_twin {

namespace {

constexpr const char* kBodeDescription =
    "Critical speeds, damping and slow roll from a table of measured 1X vectors over the speed, "
    "as\n"
    "monitoring systems export them.";

constexpr const char* kBodeFooter =
    "Columns are found by the words of their headings: speed (rpm where no unit is given); "
    "amplitude\n"
    "with its unit and pp, pk-pk or rms, otherwise from 0 to the peak; phase, a lag in deg unless "
    "the\n"
    "heading has `lead` or rad. Several probes: amplitude and phase of each.\n"
    "Modes beside the slow roll are fitted to the vectors; their amplification factor is 1 / (2 x "
    "the\ndamping ratio).\n"
    "\n"
    "Example:\n"
    "  twin bode runup_vectors.csv --plot bode.svg";

struct BodeRequest {
  std::string file;
  std::optional<std::string> import, plot, csv;
  bool json = false;
};

int bode(const BodeRequest& request) {
  requirePictureName(request.plot);
  requireCsvName(request.csv);
  const auto report = std::make_shared<const BodeReport>(bodeReport(
      request.file, request.import ? readImportSettings(*request.import).table : TableSettings()));
  Document document;
  document.json = json(*report);
  document.text = text(*report);
  document.tables = tables(*report);
  document.drawings.push_back({"bode", [report] { return figureJson(figure(*report)); }});
  return printDocument(document, request.json, request.csv, request.plot);
}

}  // namespace

void addBodeCommand(const ProgramCommand& twin, int& status) {
  const ProgramCommand command = twin.subcommand("bode", kBodeDescription);
  const auto request = std::make_shared<BodeRequest>();
  command.option("FILE", request->file, "table of vectors over the speed").required().type("");
  command.option("--plot", request->plot, "draw amplitude and phase: FILE.svg, .png, .pdf or .json")
      .type("FILE");
  addImportOption(command, request->import);
  addCsvOption(command, request->csv);
  addJsonOption(command, request->json);
  command.footer(kBodeFooter);
  command.callback([request, &status] { status = bode(*request); });
}

}  // namespace whirl_twin

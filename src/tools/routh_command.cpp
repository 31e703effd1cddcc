#include <memory>
#include <optional>
#include <string>

#include "reports/csv_table.h"
#include "requests/routh_request.h"
#include "tools/arguments.h"
#include "tools/commands.h"
#include "tools/report_options.h"

namespace whirl_twin {

namespace {

constexpr const char* kRouthDescription =
    "Counts the roots of a polynomial right of, on and left of the imaginary axis, by the\n"
    "Routh-Hurwitz test, exact for the coefficients as typed, with the distance to instability; "
    "or,\nwith a parameter, finds the values for which the polynomial is stable.";

constexpr const char* kRouthFooter =
    "Coefficients go highest power first, real (2, -0.1, 1e-3, 1/3) or complex (3+2i, -i). Put -- "
    "before\nthem if one looks like an option. Leading zeros are dropped. Where exact numbers "
    "become\n"
    "too long, the verdict is `uncertain` and the counts are those of the roots as computed. "
    "For\nreal coefficients the whole table is printed, with the treatment of rows that are or "
    "begin with zero.\n"
    "\n"
    "With --parameter K coefficients may contain K (2K, \"(K+1)/3\", K^2). The bounds are "
    "exact:\n"
    "where a root crosses 0, a pair the axis, or the degree falls; between them one exact test "
    "decides.\n"
    "\n"
    "Examples:\n"
    "  twin routh 1 2 3 4               s^3 + 2 s^2 + 3 s + 4\n"
    "  twin routh --json -- 1 -2 3      s^2 - 2 s + 3\n"
    "  twin routh 1 2 K 3 --parameter K\n"
    "  twin routh 1 0.2+3i 5-0.1i";

struct RouthOptions {
  RouthRequest request;
  std::optional<std::string> csv;
  bool json = false;
};

int test(const RouthOptions& options) {
  requireCsvName(options.csv);
  return printDocument(routhDocument(options.request), options.json, options.csv);
}

}  // namespace

void addRouthCommand(const ProgramCommand& twin, int& status) {
  const ProgramCommand command = twin.subcommand("routh", kRouthDescription);
  const auto options = std::make_shared<RouthOptions>();
  RouthRequest* const request = &options->request;
  command.option("COEFFICIENTS", request->coefficients, "A_N ... A_0, highest power first")
      .required()
      .type("");
  command
      .option("--parameter", request->parameter,
              "name of a parameter: find its values for which the polynomial is stable")
      .type("K");
  addCsvOption(command, options->csv);
  addJsonOption(command, options->json);
  addInsistOption(command, request->insist);
  command.footer(kRouthFooter);
  command.callback([options, &status] { status = test(*options); });
}

}  // namespace whirl_twin

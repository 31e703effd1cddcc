#include <fmt/format.h>

#include <memory>

#include "messages/units.h"
#include "tools/commands.h"
#include "tools/report_options.h"

namespace whirl_twin {

namespace {

constexpr const char* kUnitsDescription =
    "Lists the units that numbers may have, by quantity, with the factor to the SI unit.";

constexpr const char* kUnitsFooter =
    "They are known in scenes, studies, settings and options: \"800 rpm\", 250 mm, 15 g mm, 60 "
    "deg.\n"
    "A number without a unit is in the SI unit of what it is, which messages and help name; "
    "angles\n"
    "of balancing runs are in deg. Prefixes: n u m c d da h k M G. Products, quotients and powers "
    "are\n"
    "known as well: lbf s/in, kg mm^2, N/mm. An angle has a dimension, a turn being 2 pi rad: "
    "where\n"
    "a speed in rad/s is expected, 50 Hz are 50 turns per second, 314.16 rad/s. A pound (lb) is a\n"
    "mass, lbf a force.\n"
    "\n"
    "Examples:\n"
    "  twin units\n"
    "  twin units --json";

/// "length" of "a length".
std::string withoutArticle(const std::string& name) {
  return name.substr(name.find(' ') + 1);
}

int listUnits(bool as_json) {
  Json all;
  all["quantities"] = Json::array();
  std::string text;
  for (const QuantityUnits& quantity : unitsByQuantity()) {
    Json one{{"quantity", withoutArticle(quantity.name)}, {"unit", quantity.unit}};
    text +=
        fmt::format("{}{}\n", withoutArticle(quantity.name),
                    std::string(quantity.unit) == "-" ? "" : fmt::format(", {}", quantity.unit));
    for (const char* unit : quantity.units) {
      const double factor = unitScale(unit, quantity.unit);
      one["factors"][unit] = factor;
      text += fmt::format("  {:<14} {}\n", unit, factor);
    }
    all["quantities"].push_back(one);
  }
  return printReport(as_json, all, text);
}

}  // namespace

void addUnitsCommand(const ProgramCommand& twin, int& status) {
  const ProgramCommand command = twin.subcommand("units", kUnitsDescription);
  const auto as_json = std::make_shared<bool>(false);
  addJsonOption(command, *as_json);
  command.footer(kUnitsFooter);
  command.callback([as_json, &status] { status = listUnits(*as_json); });
}

}  // namespace whirl_twin

#include "requests/option_quantity.h"

#include <fmt/format.h>

#include <cmath>
#include <optional>

#include "messages/input_error.h"
#include "messages/names.h"
#include "messages/units.h"
#include "scene/node_reader.h"
#include "scene/written_quantity.h"

namespace whirl_twin {

std::string rangeText(const OptionQuantity& quantity) {
  const std::string unit =
      std::string(quantity.unit) == "-" ? "" : " " + std::string(quantity.unit);
  if (!std::isfinite(quantity.high)) {
    return fmt::format("{} {:g}{}", quantity.above ? ">" : ">=", quantity.low, unit);
  }
  return quantity.above ? fmt::format("above {:g}, up to {:g}{}", quantity.low, quantity.high, unit)
                        : fmt::format("from {:g} to {:g}{}", quantity.low, quantity.high, unit);
}

double readQuantity(const std::string& option, const std::string& text,
                    const OptionQuantity& quantity) {
  const std::optional<double> value = parseQuantity(text, quantity.unit);
  if (!value || !(*value >= quantity.low && *value <= quantity.high) ||
      (quantity.above && *value == quantity.low)) {
    throw InputError(fmt::format("{}: must be {} {}, found {}{}", option, quantity.what,
                                 rangeText(quantity), parseNumber(text) ? text : inQuotes(text),
                                 foundQuantity(text, quantity.unit)));
  }
  return *value;
}

std::string foundQuantity(const std::string& text, const std::string& unit) {
  const std::string why = unitDiagnostic(text, unit);
  if (why.empty()) {
    return "";
  }
  const std::string found = writtenQuantity(text)->unit;
  const std::string name = quantityName(found);
  if (name.empty()) {
    return fmt::format(" ({})", why.substr(2));
  }
  const std::string meant = unitMeant(found, unit);
  return fmt::format(" ({}){}", name,
                     meant.empty() ? "" : fmt::format("; write {}", inQuotes(meant)));
}

}  // namespace whirl_twin

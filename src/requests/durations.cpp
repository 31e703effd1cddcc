#include "requests/durations.h"

#include <fmt/format.h>

#include "analysis/exact_number.h"
#include "messages/input_error.h"
#include "messages/names.h"
#include "messages/units.h"
#include "reports/output.h"
#include "requests/option_quantity.h"
#include "scene/written_quantity.h"

namespace whirl_twin {

std::string inSeconds(std::int64_t nanoseconds) {
  return fmt::format("{} s", static_cast<double>(nanoseconds) / 1.0e9);
}

std::int64_t parseNanoseconds(const std::string& option, const std::string& text, std::int64_t low,
                              std::int64_t high, std::int64_t unit) {
  const std::string expected =
      fmt::format("must be from {} to {}", inSeconds(low), inSeconds(high));
  const auto written = writtenQuantity(text);
  const double scale = written ? unitScale(written->unit, "s") : 0.0;
  const bool known = written && (written->unit.empty() || (isUnit(written->unit) && scale != 0.0));
  Rational nanoseconds;
  try {
    if (!known && written) {
      throw InputError("another unit");
    }
    // The decimal number of a scale is exact: 0.001 of ms.
    nanoseconds = known ? parseRational(written->number) * 1000000000 *
                              parseRational(fmt::format("{}", scale))
                        : parseRational(text) * 1000000000;
  } catch (const InputError&) {
    throw InputError(fmt::format("{}: {}, found {}{}", option, expected, inQuotes(text),
                                 foundQuantity(text, "s")));
  }
  const std::string given = known && !written->unit.empty() ? text : text + " s";
  if (nanoseconds < low || nanoseconds > high) {
    throw InputError(fmt::format("{}: {}, found {}", option, expected, printable(given)));
  }
  const Rational units = nanoseconds / unit + Rational(1, 2);  // floor of this: nearest integer
  const auto whole = static_cast<std::int64_t>(numerator(units) / denominator(units)) * unit;
  if (nanoseconds != whole) {
    complain(fmt::format("twin: {}: {} is not a whole number of {}: {} is used\n", option, given,
                         unit == 1 ? "nanoseconds" : "steps of " + inSeconds(unit),
                         inSeconds(whole)));
  }
  return whole;
}

}  // namespace whirl_twin

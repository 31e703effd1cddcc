#include "requests/durations.h"

#include <fmt/format.h>

#include "analysis/exact_number.h"
#include "messages/input_error.h"
#include "reports/output.h"

namespace whirl_twin {

std::string inSeconds(std::int64_t nanoseconds) {
  return fmt::format("{} s", static_cast<double>(nanoseconds) / 1.0e9);
}

std::int64_t parseNanoseconds(const std::string& option, const std::string& text, std::int64_t low,
                              std::int64_t high, std::int64_t unit) {
  const std::string expected =
      fmt::format("must be from {} to {}", inSeconds(low), inSeconds(high));
  Rational nanoseconds;
  try {
    nanoseconds = parseRational(text) * 1000000000;
  } catch (const InputError&) {
    throw InputError(fmt::format("{}: {}, found '{}'", option, expected, text));
  }
  if (nanoseconds < low || nanoseconds > high) {
    throw InputError(fmt::format("{}: {}, found {} s", option, expected, text));
  }
  const Rational units = nanoseconds / unit + Rational(1, 2);  // floor of this: nearest integer
  const auto whole = static_cast<std::int64_t>(numerator(units) / denominator(units)) * unit;
  if (nanoseconds != whole) {
    complain(fmt::format("twin: {}: {} s is not a whole number of {}: {} is used\n", option, text,
                         unit == 1 ? "nanoseconds" : "steps of " + inSeconds(unit),
                         inSeconds(whole)));
  }
  return whole;
}

}  // namespace whirl_twin

#include "tools/arguments.h"

#include <fmt/format.h>
#include <fnmatch.h>

#include <algorithm>

#include "analysis/exact_number.h"
#include "messages/input_error.h"
#include "messages/names.h"
#include "messages/units.h"
#include "reports/output.h"
#include "scene/node_reader.h"
#include "scene/written_quantity.h"
#include "tools/option_quantity.h"

namespace whirl_twin {

void addChannelOption(const ProgramCommand& command, ChannelFilter& filter) {
  command
      .option("--channel", filter,
              "only channels (of a bag: topics) that match, such as '*_WHIRL'; may be repeated")
      .type("PATTERN")
      .oneByOne();
}

bool selects(const ChannelFilter& filter, const std::string& channel) {
  return filter.empty() ||
         std::any_of(filter.begin(), filter.end(), [&](const std::string& pattern) {
           return fnmatch(pattern.c_str(), channel.c_str(), 0) == 0;
         });
}

void addInsistOption(const ProgramCommand& command, bool& insist) {
  command.flag("--insist", insist,
               "run even if it takes more than a day or more memory than is free");
}

void addCsvOption(const ProgramCommand& command, std::optional<std::string>& csv) {
  command.option("--csv", csv, "write the complete tables: FILE.csv, FILE_NAME.csv")
      .type("FILE.csv");
}

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

std::vector<std::string> orderedArguments(int argc, const char* const* argv) {
  std::vector<std::string> arguments(argv + 1, argv + argc);
  if (arguments.empty() || arguments.front() != "routh") {
    return arguments;
  }
  std::vector<std::string> options{"routh"};
  std::vector<std::string> coefficients{"--"};
  for (auto it = arguments.begin() + 1; it != arguments.end(); ++it) {
    if (*it == "--") {
      coefficients.insert(coefficients.end(), it + 1, arguments.end());
      break;
    }
    if (*it != "-h" && it->compare(0, 2, "--") != 0) {
      coefficients.push_back(*it);
      continue;
    }
    options.push_back(*it);
    if ((*it == "--parameter" || *it == "--csv") && it + 1 != arguments.end()) {
      options.push_back(*++it);
    }
  }
  options.insert(options.end(), coefficients.begin(), coefficients.end());
  return options;
}

}  // namespace whirl_twin

#include "tools/arguments.h"

#include <fmt/format.h>

#include <algorithm>

#include "analysis/exact_number.h"
#include "messages/names.h"
#include "messages/refusal.h"

namespace whirl_twin {

void addSceneOption(CLI::App* command, std::string& scene) {
  command->add_option("SCENE", scene, "scene file (YAML), or the name of a scene of the package")
      ->required()
      ->type_name("");
}

std::string inSeconds(std::int64_t nanoseconds) {
  return fmt::format("{} s", static_cast<double>(nanoseconds) / 1.0e9);
}

std::int64_t parseNanoseconds(const std::string& option, const std::string& text, std::int64_t low,
                              std::int64_t high) {
  const std::string expected =
      fmt::format("must be from {} to {}", inSeconds(low), inSeconds(high));
  Rational nanoseconds;
  try {
    nanoseconds = parseRational(text) * 1000000000;
  } catch (const std::invalid_argument&) {
    throw Refusal(fmt::format("{}: {}, found '{}'", option, expected, text));
  }
  if (nanoseconds < low || nanoseconds > high) {
    throw Refusal(fmt::format("{}: {}, found {} s", option, expected, text));
  }
  if (denominator(nanoseconds) != 1) {
    throw Refusal(
        fmt::format("{}: must be a whole number of nanoseconds, found {} s", option, text));
  }
  return static_cast<std::int64_t>(numerator(nanoseconds));
}

std::vector<std::string> orderedArguments(int argc, const char* const* argv) {
  std::vector<std::string> arguments(argv + 1, argv + argc);
  if (arguments.empty() || arguments.front() != "routh") {
    return arguments;
  }
  const auto dashes = std::find(arguments.begin(), arguments.end(), "--");
  const auto first_coefficient =
      std::stable_partition(arguments.begin() + 1, dashes, [](const std::string& argument) {
        return argument == "-h" || argument.compare(0, 2, "--") == 0;
      });
  if (dashes != arguments.end()) {
    arguments.erase(dashes);
  }
  arguments.insert(first_coefficient, "--");
  return arguments;
}

}  // namespace whirl_twin

#include "tools/arguments.h"

#include <fnmatch.h>

#include <algorithm>

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

Option addSetOption(const ProgramCommand& command, SceneArgument& scene) {
  command.takeUnits();
  return command
      .option("--set", scene.changes,
              "replace a value of the scene before it is checked: rotor.damping=8, "
              "\"rotor.discs[0].mass=500 g\", \"shaft.speed=800 rpm\"; may be repeated")
      .type("PATH=VALUE")
      .oneByOne();
}

void addSceneOption(const ProgramCommand& command, SceneArgument& scene) {
  command
      .option("SCENE", scene.name,
              "scene file (YAML), the name of a scene of the package, or - for standard input")
      .required()
      .type("");
  addSetOption(command, scene);
}

void addInsistOption(const ProgramCommand& command, bool& insist) {
  command.flag("--insist", insist,
               "run even if it takes more than a day or more memory than is free");
}

Option addImportOption(const ProgramCommand& command, std::optional<std::string>& import) {
  return command
      .option(
          "--import", import,
          "how a table of measurements is read, YAML; default: by its first lines and the names "
          "of its columns")
      .type("FILE");
}

void addCsvOption(const ProgramCommand& command, std::optional<std::string>& csv) {
  command.option("--csv", csv, "write the complete tables: FILE.csv, FILE_NAME.csv")
      .type("FILE.csv");
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

// `twin`: the command line of the twin. See `twin --help`.

#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <string>
#include <vector>

#ifdef WHIRL_TWIN_PLUGINS
#include "plugins/plugins.h"
#endif
#include "messages/input_error.h"
#include "messages/names.h"
#include "messages/units.h"
#include "reports/output.h"
#include "scene/node_reader.h"
#include "scene/scene_reader.h"
#include "tools/arguments.h"
#include "tools/commands.h"
#include "tools/patience.h"

namespace whirl_twin {

namespace {

constexpr const char* kTwinDescription =
    "A digital twin of whirling rotors and pendulums, from a scene file.\n"
    "Check a scene, run it, analyse its stability, inspect recorded logs.";

constexpr const char* kTwinFooter =
    "First steps:\n"
    "  twin serve demo           runs it, live in a browser\n"
    "  twin check demo           checks the scene and prints what is modelled\n"
    "  twin analyze demo         equilibria, frequencies, stability, criticals\n"
    "  twin simulate demo --sample 0.01 --output demo.csv\n"
    "  twin plot demo            its systems and their motions, as pictures\n"
    "  twin routh 1 2 3 4        is s^3 + 2 s^2 + 3 s + 4 stable\n"
    "`twin COMMAND --help` prints more. Numbers are in SI units (m, kg, s, rad, N) or have a "
    "unit:\n"
    "\"800 rpm\", 250 mm, \"5 mil\" (`twin units`).\n"
    "\n"
    "Results go to standard output, messages to standard error.\n"
    "Exit status: 0 done, 1 the run failed (diverged, a file cannot be written), 2 bad input.";

/// The commands of `twin`, or the long names of a command's options.
std::vector<std::string> names(const CLI::App& twin) {
  std::vector<std::string> all;
  for (const CLI::App* command : twin.get_subcommands([](const CLI::App*) { return true; })) {
    all.push_back(command->get_name());
  }
  return all;
}
std::vector<std::string> optionNames(const CLI::App& command) {
  std::vector<std::string> all;
  for (const CLI::Option* option : command.get_options()) {
    for (const std::string& name : option->get_lnames()) {
      all.push_back("--" + name);
    }
  }
  return all;
}

/// The error in the usage, with a hint for a misspelled name.
void explain(const CLI::App& twin, const CLI::ParseError& error) {
  const auto given = twin.get_subcommands();
  const CLI::App& command = given.empty() ? twin : *given.front();
  const std::string name = given.empty() ? "twin" : "twin " + command.get_name();
  std::string what = error.what();
  for (const std::string& rest : twin.remaining(true)) {
    const std::string near =
        rest.compare(0, 2, "--") == 0 ? nearestName(rest, optionNames(command)) : "";
    if (!near.empty()) {
      what = fmt::format("unknown option '{}'; did you mean '{}'?", rest, near);
    } else if (isUnit(rest)) {
      what = fmt::format("a number and its unit must be in quotes: \"800 rpm\"; found {}",
                         inQuotes(rest));
    }
  }
  complain(fmt::format("{}: {}\n`{} --help` prints its usage.\n", name, what, name));
}

/// Reports an unknown command before CLI11 treats it as a stray argument.
bool unknownCommand(const CLI::App& twin, const std::vector<std::string>& arguments) {
  if (arguments.empty()) {
    complain(fmt::format("twin: expected a command{}\n", hint("", names(twin))));
    return true;
  }
  const std::vector<std::string> commands = names(twin);
  const std::string& first = arguments.front();
  if (first.compare(0, 1, "-") == 0 ||
      std::find(commands.begin(), commands.end(), first) != commands.end()) {
    return false;
  }
  complain(fmt::format("twin: unknown command '{}'{}\n`twin --help` lists the commands.\n", first,
                       hint(first, commands)));
  return true;
}

int run(int argc, const char* const* argv) {
  int status = kDone;
  CLI::App twin(kTwinDescription, "twin");
  twin.footer(kTwinFooter);
  twin.set_version_flag("--version", "twin (whirl_twin) " WHIRL_TWIN_VERSION,
                        "print the version and exit");
  twin.require_subcommand(1);
  const ProgramCommand commands(&twin);
  addCheckCommand(commands, status);
  addScenesCommand(commands, status);
  addModelsCommand(commands, status);
  addControllersCommand(commands, status);
  addUnitsCommand(commands, status);
  addNewCommand(commands, status);
  addImportCommand(commands, status);
  addSimulateCommand(commands, status);
  addServeCommand(commands, status);
  addPlotCommand(commands, status);
  addAnalyzeCommand(commands, status);
  addCampbellCommand(commands, status);
  addResponseCommand(commands, status);
  addOrbitCommand(commands, status);
  addMapCommand(commands, status);
  addStabilityCommand(commands, status);
  addReportCommand(commands, status);
  addLoopCommand(commands, status);
  addModesCommand(commands, status);
  addBodeCommand(commands, status);
  addBalanceCommand(commands, status);
  addTradeoffCommand(commands, status);
  addSweepCommand(commands, status);
  addRouthCommand(commands, status);
  addLogCommand(commands, status);
  addRecordCommand(commands, status);
  addPlayCommand(commands, status);
  addSpyCommand(commands, status);
  addWatchCommand(commands, status);
  addExportCommand(commands, status);
  addMonitorCommand(commands, status);
  addFitCommand(commands, status);
  addFollowCommand(commands, status);

  std::vector<std::string> arguments = orderedArguments(argc, argv);
  if (unknownCommand(twin, arguments)) {
    return kBadInput;
  }
  std::reverse(arguments.begin(), arguments.end());  // as CLI11 takes a vector
  const Patience patience("twin " + arguments.back());
  try {
    twin.parse(arguments);
    finishStandardOutput();
    return status;
  } catch (const CLI::CallForHelp&) {
    const auto given = twin.get_subcommands();
    printText(given.empty() ? twin.help() : given.front()->help("twin"));
    finishStandardOutput();
    return kDone;
  } catch (const CLI::CallForVersion& version) {
    printText(std::string(version.what()) + "\n");
    finishStandardOutput();
    return kDone;
  } catch (const CLI::ParseError& error) {
    explain(twin, error);
    return kBadInput;
  }
}

}  // namespace

}  // namespace whirl_twin

int main(int argc, char** argv) {
  try {
#ifdef WHIRL_TWIN_PLUGINS
    whirl_twin::usePlugins();
#endif
    return whirl_twin::run(argc, argv);
  } catch (const whirl_twin::SceneError& error) {
    whirl_twin::complain(fmt::format("{}\n", error.what()));
    return whirl_twin::kBadInput;
  } catch (const whirl_twin::InputError& error) {
    whirl_twin::complain(fmt::format("twin: {}\n", error.what()));
    return whirl_twin::kBadInput;
  } catch (const std::exception& error) {
    whirl_twin::complain(fmt::format("twin: {}\n", error.what()));
    return whirl_twin::kFailed;
  }
}

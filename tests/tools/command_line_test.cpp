// `twin` prints its usage, and the error of an invalid command line.
#include <gtest/gtest.h>

#include "twin_program.h"

namespace whirl_twin {
namespace command_line_test {

using testing::TestWithParam;

bool contains(const std::string& text, const std::string& part) {
  return text.find(part) != std::string::npos;
}

/// In the order of `twin --help`.
constexpr const char* kCommands[] = {
    "check",    "scenes",    "models",  "controllers", "units",    "new",      "import",
    "simulate", "serve",     "plot",    "analyze",     "campbell", "response", "orbit",
    "map",      "stability", "report",  "loop",        "modes",    "bode",     "balance",
    "tradeoff", "sweep",     "routh",   "log",         "record",   "play",     "spy",
    "watch",    "export",    "monitor", "fit",         "follow"};

/// "; there are: check, scenes, ...", as reported for an unknown command.
std::string thereAre() {
  std::string all;
  for (const char* command : kCommands) {
    all += (all.empty() ? "; there are: " : ", ") + std::string(command);
  }
  return all;
}

TEST(CommandLine, HelpNamesEveryCommand) {
  const Ending help = twin({"--help"});
  EXPECT_EQ(help.status, 0);
  EXPECT_EQ(help.err, "");
  for (const char* command : kCommands) {
    EXPECT_TRUE(contains(help.out, std::string("\n  ") + command + " ")) << command;
  }
  EXPECT_TRUE(contains(help.out, "Exit status"));
}

class CommandHelp : public TestWithParam<const char*> {};

TEST_P(CommandHelp, TellsWhatItDoesWithAnExample) {
  const Ending help = twin({GetParam(), "--help"});
  EXPECT_EQ(help.status, 0);
  EXPECT_TRUE(contains(help.out, std::string("Usage: twin ") + GetParam())) << help.out;
  EXPECT_TRUE(contains(help.out, "Examples:\n") || contains(help.out, "Example:\n")) << help.out;
  EXPECT_TRUE(contains(help.out, std::string("  twin ") + GetParam())) << help.out;
  EXPECT_EQ(twin({GetParam(), "-h"}).out, help.out);
}

// Without Ceres `fit` only reports how to get it.
INSTANTIATE_TEST_SUITE_P(Commands, CommandHelp,
                         testing::Values("check", "scenes", "models", "units", "new", "simulate",
                                         "serve", "plot", "analyze", "campbell", "response",
                                         "orbit", "map", "stability", "report", "loop", "modes",
                                         "bode", "balance", "tradeoff", "sweep", "routh", "log",
                                         "record", "play", "spy", "watch", "export", "monitor",
                                         "follow"));

TEST(CommandLine, TheVersionIsThatOfThePackage) {
  const std::string package = contentsOf(WHIRL_TWIN_SOURCE "/package.xml");
  const std::size_t begin = package.find("<version>") + std::string("<version>").size();
  const std::string version = package.substr(begin, package.find("</version>") - begin);
  const Ending result = twin({"--version"});
  EXPECT_EQ(result.status, 0);
  EXPECT_EQ(result.err, "");
  EXPECT_EQ(result.out, "twin (whirl_twin) " + version + "\n");
}

struct Misuse {
  std::vector<std::string> arguments;
  std::string message;  ///< the first line on standard error
};

class Misused : public TestWithParam<Misuse> {};

TEST_P(Misused, IsRefusedWithOneMessage) {
  const Ending end = twin(GetParam().arguments);
  EXPECT_EQ(end.status, 2);
  EXPECT_EQ(end.out, "");
  ASSERT_FALSE(linesOf(end.err).empty());
  EXPECT_EQ(linesOf(end.err).front(), GetParam().message);
}

INSTANTIATE_TEST_SUITE_P(
    Usages, Misused,
    testing::Values(
        Misuse{{}, "twin: expected a command" + thereAre()},
        Misuse{{"analyse", kDemo}, "twin: unknown command 'analyse'; did you mean 'analyze'?"},
        Misuse{{"nyquist", kDemo}, "twin: unknown command 'nyquist'" + thereAre()},
        Misuse{{""}, "twin: unknown command ''" + thereAre()},
        Misuse{{"check"}, "twin check: SCENE is required"},
        Misuse{{"routh"}, "twin routh: COEFFICIENTS is required"},
        Misuse{{"log"}, "twin log: FILE is required"},
        Misuse{{"check", kDemo, "--jsn"},
               "twin check: unknown option '--jsn'; did you mean '--json'?"},
        Misuse{{"simulate", kDemo, "--integratr", "auto"},
               "twin simulate: unknown option '--integratr'; did you mean '--integrator'?"},
        Misuse{{"models", "jefcott_rotor"},
               "twin: no model 'jefcott_rotor'; did you mean 'jeffcott_rotor'?"},
        Misuse{{"check", kDemo, "--system", "roter"},
               "twin: --system: no system 'roter' in " + kDemo + "; did you mean 'rotor'?"},
        Misuse{{"analyze", kDemo, "--system", ""},
               "twin: --system: no system '' in " + kDemo + "; there are: rotor, pendulum"}));

TEST(CommandLine, ResultsThatCannotBeWrittenFailTheRun) {
  for (const std::vector<std::string>& arguments :
       std::vector<std::vector<std::string>>{{"check", kDemo},
                                             {"models", "--json"},
                                             {"analyze", kDemo},
                                             {"simulate", kDemo, "--duration", "1"},
                                             {"routh", "1", "2", "3"},
                                             {"--help"}}) {
    const Ending end = twin(arguments, "/dev/full");
    EXPECT_EQ(end.status, 1) << arguments.front();
    EXPECT_EQ(end.err, "twin: standard output: cannot be written: No space left on device\n");
  }
}

}  // namespace command_line_test
}  // namespace whirl_twin

// `twin` teaches its use, and says what is wrong with a usage that is not one.
#include <gtest/gtest.h>

#include "twin_program.h"

namespace whirl_twin {
namespace {

using testing::TestWithParam;

bool contains(const std::string& text, const std::string& part) {
  return text.find(part) != std::string::npos;
}

TEST(CommandLine, HelpNamesEveryCommand) {
  const Ending help = twin({"--help"});
  EXPECT_EQ(help.status, 0);
  EXPECT_EQ(help.err, "");
  for (const char* command :
       {"check", "scenes", "models", "simulate", "plot", "analyze", "routh", "log"}) {
    EXPECT_TRUE(contains(help.out, command)) << command;
  }
  EXPECT_TRUE(contains(help.out, "Exit status"));
}

class CommandHelp : public TestWithParam<const char*> {};

TEST_P(CommandHelp, TellsWhatItDoesWithAnExample) {
  const Ending help = twin({GetParam(), "--help"});
  EXPECT_EQ(help.status, 0);
  EXPECT_TRUE(contains(help.out, std::string("Usage: twin ") + GetParam())) << help.out;
  EXPECT_TRUE(contains(help.out, "Examples:\n")) << help.out;
  EXPECT_TRUE(contains(help.out, std::string("  twin ") + GetParam())) << help.out;
  EXPECT_EQ(twin({GetParam(), "-h"}).out, help.out);
}

INSTANTIATE_TEST_SUITE_P(Commands, CommandHelp,
                         testing::Values("check", "scenes", "models", "simulate", "plot", "analyze",
                                         "routh", "log"));

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
        Misuse{
            {},
            "twin: expected a command; there are: check, scenes, models, simulate, plot, analyze, "
            "campbell, response, orbit, loop, modes, balance, tradeoff, routh, log, "
            "monitor, fit, follow"},
        Misuse{{"analyse", kDemo}, "twin: unknown command 'analyse'; did you mean 'analyze'?"},
        Misuse{{"nyquist", kDemo},
               "twin: unknown command 'nyquist'; there are: check, scenes, models, simulate, plot, "
               "analyze, campbell, response, orbit, loop, modes, balance, tradeoff, routh, log, "
               "monitor, fit, follow"},
        Misuse{{""},
               "twin: unknown command ''; there are: check, scenes, models, simulate, plot, "
               "analyze, campbell, response, orbit, loop, modes, balance, tradeoff, routh, log, "
               "monitor, fit, follow"},
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

}  // namespace
}  // namespace whirl_twin

// `twin simulate`: invalid options, files that cannot be written, systems that stop.
#include <gtest/gtest.h>

#include <csignal>

#include "twin_program.h"

namespace whirl_twin {
namespace simulate_output_test {

using Json = nlohmann::json;

struct Refused {
  std::vector<std::string> options;
  Lines messages;
};

class RefusedSimulateOptions : public testing::TestWithParam<Refused> {};

TEST_P(RefusedSimulateOptions, SayWhatWasExpected) {
  std::vector<std::string> arguments{"simulate", kDemo};
  arguments.insert(arguments.end(), GetParam().options.begin(), GetParam().options.end());
  const Ending end = twin(arguments);
  EXPECT_EQ(end.status, 2);
  EXPECT_EQ(end.out, "");
  EXPECT_EQ(linesOf(end.err), GetParam().messages);
}

INSTANTIATE_TEST_SUITE_P(
    Simulate, RefusedSimulateOptions,
    testing::Values(
        Refused{{"--sample", "0"},
                {"twin: --sample: must be from 0.001 s to 1000000000 s, found 0 s"}},
        Refused{{"--duration", "-1"},
                {"twin: --duration: must be from 0 s to 1000000000 s, found -1 s"}},
        Refused{{"--duration", "nan"},
                {"twin: --duration: must be from 0 s to 1000000000 s, found 'nan'"}},
        Refused{{"--duration", "1e300"},
                {"twin: --duration: must be from 0 s to 1000000000 s, found 1e300 s"}},
        Refused{{"--step", "1e-10"}, {"twin: --step: must be from 1e-09 s to 10 s, found 1e-10 s"}},
        Refused{{"--step", "11"}, {"twin: --step: must be from 1e-09 s to 10 s, found 11 s"}},
        Refused{{"--step", ""}, {"twin: --step: must be from 1e-09 s to 10 s, found ''"}},
        Refused{{"--integrator", "runge_kuta_4"},
                {"twin: --integrator: no integrator 'runge_kuta_4'; did you mean "
                 "'runge_kutta_4'?"}},
        Refused{{"--integrator", "exponential"},
                {"twin: --integrator: pendulum: exponential is for linear systems; "
                 "spinning_pendulum is not linear"}},
        Refused{{"--output", "demo.txt"},
                {"twin: --output: must end in .csv, .lcmlog or .mcap, found 'demo.txt'"}}));

// A third or two thirds of a second, computed in a shell, is no whole number of steps.
TEST(Times, AreRoundedToWholeStepsAndItIsSaid) {
  struct Case {
    std::vector<std::string> options;
    std::string said;
    int steps;
  };
  for (const Case& c :
       {Case{{"--duration", "0.6666666666666666"},
             "twin: --duration: 0.6666666666666666 s is not a whole number of steps of 0.001 s: "
             "0.667 s is used\n",
             667},
        Case{{"--duration", "0.0004"},
             "twin: --duration: 0.0004 s is not a whole number of steps of 0.001 s: 0 s is used\n",
             0},
        Case{{"--duration", "0.1", "--sample", "0.0333333333333"},
             "twin: --sample: 0.0333333333333 s is not a whole number of steps of 0.001 s: 0.033 s "
             "is used\n",
             100},
        Case{{"--duration", "0.01", "--step", "0.00033333333333"},
             "twin: --step: 0.00033333333333 s is not a whole number of nanoseconds: 0.000333333 s "
             "is used\n"
             "twin: --duration: 0.01 s is not a whole number of steps of 0.000333333 s: 0.00999999 "
             "s "
             "is used\n",
             30},
        Case{{"--duration", "0.667"}, "", 667}}) {
    std::vector<std::string> arguments{"simulate", kDemo, "--json"};
    arguments.insert(arguments.end(), c.options.begin(), c.options.end());
    const Ending end = twin(arguments);
    EXPECT_EQ(end.status, 0);
    EXPECT_EQ(end.err, c.said);
    EXPECT_EQ(end.json()["steps"], c.steps);
  }
}

// A pendulum calibrated while it creeps away from its upright equilibrium, which then falls.
TEST(Output, ARunLessAccurateThanPromisedSaysSo) {
  const TemporaryDirectory directory;
  const std::string scene = directory.write("falls.yaml", R"(
name: falls
step: 0.05
systems:
  arms: {model: double_pendulum, tolerance: 1.0e-6, horizon: 0.1,
    parameters: {mass1: 1, mass2: 1, length1: 1, length2: 1}, initial: {theta1: 3, theta2: 3}}
)");
  const Ending kept = twin({"simulate", scene, "--duration", "0.1", "--json"});
  ASSERT_EQ(kept.status, 0) << kept.err;
  EXPECT_EQ(kept.err, "");
  EXPECT_TRUE(kept.json()["systems"]["arms"]["accuracy_lost"].is_null());
  EXPECT_GT(kept.json()["systems"]["arms"]["error_estimate"].get<double>(), 0.0) << "two steps";
  const Ending lost = twin({"simulate", scene, "--duration", "20", "--json"});
  ASSERT_EQ(lost.status, 0);
  EXPECT_NE(lost.err.find("ACCURACY_LOST"), std::string::npos) << lost.err;
  EXPECT_GT(lost.json()["systems"]["arms"]["accuracy_lost"].get<double>(), 0.1);
}

TEST(Output, FileHasTheBytesOfStandardOutput) {
  const TemporaryDirectory directory;
  const std::string path = directory.file("demo.csv");
  const Ending end = twin({"simulate", kDemo, "--duration", "1", "--output", path});
  EXPECT_EQ(end.status, 0) << end.err;
  EXPECT_EQ(end.out, "");
  EXPECT_EQ(contentsOf(path), twin({"simulate", kDemo, "--duration", "1"}).out);
  EXPECT_EQ(directory.files(), std::vector<std::string>{"demo.csv"});
}

TEST(Output, FileAndJsonTogether) {
  const TemporaryDirectory directory;
  const Ending end = twin(
      {"simulate", kDemo, "--duration", "1", "--json", "--output", directory.file("demo.csv")});
  EXPECT_EQ(end.json()["steps"], 1000);
  EXPECT_EQ(linesOf(contentsOf(directory.file("demo.csv"))).size(), 1u + 1001u);
}

// A log contains the simulated scene, before its first state, for playback.
TEST(Output, ALogHasTheSceneThatWasSimulated) {
  const TemporaryDirectory directory;
  const std::string log = directory.file("demo.lcmlog");
  ASSERT_EQ(
      twin({"simulate", kDemo, "--duration", "0.01", "--step", "0.002", "--output", log}).status,
      0);
  const std::string bytes = contentsOf(log);
  const std::size_t scene = bytes.find("TWIN_SCENE");
  ASSERT_NE(scene, std::string::npos);
  EXPECT_LT(scene, bytes.find("TWIN_ROTOR_WHIRL"));
  EXPECT_EQ(bytes.find("TWIN_SCENE", scene + 1), std::string::npos) << "once";
  EXPECT_NE(bytes.find("step: 0.002", scene), std::string::npos);
  EXPECT_NE(bytes.find("model: jeffcott_rotor", scene), std::string::npos);
}

TEST(Output, FileThatCannotBeWrittenFailsTheRun) {
  const TemporaryDirectory directory;
  std::filesystem::create_directory(directory.file("taken.csv"));
  for (const std::string& path :
       {directory.file("none/demo.csv"), directory.file("none/demo.lcmlog"),
        directory.file("taken.csv"), std::string("/proc/demo.csv"),
        std::string("/proc/demo.lcmlog")}) {
    const Ending end = twin({"simulate", kDemo, "--duration", "1", "--output", path});
    EXPECT_EQ(end.status, 1) << path;
    EXPECT_NE(end.err.find(path), std::string::npos) << end.err;
    EXPECT_NE(end.err.find("cannot be written"), std::string::npos) << end.err;
  }
  EXPECT_EQ(directory.files(), std::vector<std::string>{"taken.csv"});
}

TEST(Output, FullDeviceFailsTheRun) {
  const TemporaryDirectory directory;
  for (const char* name : {"full.csv", "full.lcmlog"}) {
    const std::string path = directory.file(name);
    std::filesystem::create_symlink("/dev/full", path);
    const Ending end = twin({"simulate", kDemo, "--duration", "1", "--output", path});
    EXPECT_EQ(end.status, 1) << name;
    EXPECT_NE(end.err.find("No space left on device"), std::string::npos) << end.err;
    EXPECT_TRUE(std::filesystem::is_symlink(path)) << "the device was replaced by a file";
  }
}

TEST(Output, InterruptedRunLeavesNothingBehind) {
  for (const char* name : {"long.csv", "long.lcmlog"}) {
    const TemporaryDirectory directory;
    const TemporaryDirectory messages;
    const pid_t run =
        startTwin({"simulate", kDemo, "--duration", "1000000", "--output", directory.file(name)},
                  messages.file("out"), messages.file("err"));
    while (directory.files().empty()) {  // it has begun; startTwin() ends what never does
      ::usleep(1000);
      ASSERT_EQ(::waitpid(run, nullptr, WNOHANG), 0) << contentsOf(messages.file("err"));
    }
    ::kill(run, SIGINT);
    EXPECT_EQ(statusOf(run), 1);
    EXPECT_NE(contentsOf(messages.file("err")).find("interrupted after "), std::string::npos);
    EXPECT_TRUE(directory.files().empty());
  }
}

TEST(Output, ReplacesAFileOnlyWhenComplete) {
  const TemporaryDirectory directory;
  const std::string path = directory.write("demo.csv", "what was there before");
  EXPECT_EQ(twin({"simulate", kDemo, "--duration", "1e99", "--output", path}).status, 2);
  EXPECT_EQ(contentsOf(path), "what was there before");
  EXPECT_EQ(twin({"simulate", kDemo, "--duration", "1", "--output", path}).status, 0);
  EXPECT_EQ(linesOf(contentsOf(path)).size(), 1u + 1001u);
}

// Stiffness 1e8 N/m on 1 kg: 1e4 rad/s, far beyond the limit 2/h of velocity_verlet at h = 1 ms.
class DivergingScene : public testing::Test {
 protected:
  const TemporaryDirectory directory_;
  const std::string scene_ = directory_.write("scene.yaml", R"(
step: 0.001
systems:
  wild:
    model: jeffcott_rotor
    integrator: velocity_verlet
    parameters: {mass: 1, stiffness: 1.0e+8, speed: 0}
    initial: {x: 0.001}
  calm:
    model: jeffcott_rotor
    parameters: {mass: 1, stiffness: 100, speed: 0}
    initial: {x: 0.001}
)");
};

TEST_F(DivergingScene, NamesTheSystemAndLetsTheOthersGoOn) {
  const Ending end = twin({"simulate", scene_, "--duration", "1", "--json"});
  EXPECT_EQ(end.status, 1);
  ASSERT_EQ(linesOf(end.err).size(), 1u) << end.err;
  for (const char* part : {"twin: wild: stopped in step ", "(t = ", "state not finite",
                           "last valid state: x = ", "y_rate = "}) {
    EXPECT_NE(end.err.find(part), std::string::npos) << end.err;
  }
  const Json wild = end.json()["systems"]["wild"];
  EXPECT_EQ(wild["status"], "state not finite");
  EXPECT_LT(wild["steps"], 1000);
  EXPECT_TRUE(wild["state"]["x"].is_number()) << "the last good state";
  EXPECT_TRUE(wild["energy"].is_null());
  EXPECT_EQ(end.json()["systems"]["calm"]["status"], "ok");
  EXPECT_EQ(end.json()["systems"]["calm"]["steps"], 1000);
}

TEST_F(DivergingScene, TableGoesOnWithNan) {
  const std::string path = directory_.file("out.csv");
  const Ending end = twin({"simulate", scene_, "--duration", "1", "--output", path});
  EXPECT_EQ(end.status, 1);
  const Lines rows = linesOf(contentsOf(path));
  // calm: x = 0.001 cos(10 t) = -0.00083907 m at 1 s.
  ASSERT_EQ(rows.size(), 1u + 1001u);
  EXPECT_EQ(rows.back().find("1,nan,nan,nan,nan,nan,nan,nan,nan,0,0,-0.00083"), 0u) << rows.back();
}

TEST_F(DivergingScene, ASystemThatIsNotShownDoesNotFailTheRun) {
  const Ending end = twin({"simulate", scene_, "--duration", "1", "--system", "calm", "--json"});
  EXPECT_EQ(end.status, 0);
  EXPECT_EQ(end.err, "");
}

}  // namespace simulate_output_test
}  // namespace whirl_twin

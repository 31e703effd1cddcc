// `twin plot`: its files, their formats, and errors.
#include <gtest/gtest.h>

#include "twin_program.h"

namespace whirl_twin {
namespace plot_command_test {

using Names = std::vector<std::string>;

TEST(Plot, DrawsEverySystem) {
  const TemporaryDirectory folder;
  const Ending end = twin({"plot", kDemo, "--duration", "2", "--output", folder.file("")});
  EXPECT_EQ(end.status, 0) << end.err;
  const Names all{"pendulum_energy.svg", "pendulum_phase.svg", "pendulum_picture.svg",
                  "pendulum_time.svg",   "rotor_energy.svg",   "rotor_phase.svg",
                  "rotor_time.svg"};  // a whirling disc has no picture to scale
  EXPECT_EQ(folder.files(), all);
  EXPECT_EQ(linesOf(end.out).size(), all.size());
  for (const std::string& line : linesOf(end.out)) {
    EXPECT_TRUE(std::filesystem::is_regular_file(line)) << line;
  }
  EXPECT_EQ(contentsOf(folder.file("rotor_time.svg")).substr(0, 5), "<svg ");
  EXPECT_NE(contentsOf(folder.file("rotor_phase.svg")).find("y (m)"), std::string::npos);
}

TEST(Plot, DrawsOneSystemAsPng) {
  const TemporaryDirectory folder;
  const Ending end = twin({"plot", kDemo, "--system", "pendulum", "--duration", "1", "--output",
                           folder.file(""), "--format", "png"});
  EXPECT_EQ(end.status, 0) << end.err;
  EXPECT_EQ(folder.files(), (Names{"pendulum_energy.png", "pendulum_phase.png",
                                   "pendulum_picture.png", "pendulum_time.png"}));
  EXPECT_EQ(contentsOf(folder.file("pendulum_time.png")).substr(0, 8), "\x89PNG\r\n\x1a\n");
}

TEST(Plot, OfTheSameRunIsTheSame) {
  const TemporaryDirectory one, other;
  twin({"plot", kDemo, "--duration", "1", "--format", "json", "--output", one.file("")});
  twin({"plot", kDemo, "--duration", "1", "--format", "json", "--output", other.file("")});
  for (const std::string& name : one.files()) {
    EXPECT_EQ(contentsOf(one.file(name)), contentsOf(other.file(name))) << name;
  }
}

TEST(Plot, OfNoDurationShowsTheStart) {
  const TemporaryDirectory folder;
  EXPECT_EQ(
      twin({"plot", kDemo, "--duration", "0", "--format", "json", "--output", folder.file("")})
          .status,
      0);
  EXPECT_EQ(folder.files().size(), 7u);
}

TEST(Plot, DrawsWhatControllersGiveBesideTheStates) {
  const TemporaryDirectory folder;
  const Ending end = twin({"plot", WHIRL_TWIN_SOURCE "/config/scenes/swing_up.yaml", "--duration",
                           "2", "--format", "json", "--output", folder.file("")});
  EXPECT_EQ(end.status, 0) << end.err;
  const std::string picture = contentsOf(folder.file("arm_time.json"));
  EXPECT_NE(picture.find("torque (N m) over time (s)"), std::string::npos);
}

/// The descriptions of the figures of a scene: their charts, curves and marks.
std::string wordsOf(const std::string& scene, const std::string& system, const std::string& kind,
                    const Names& options = {}) {
  const TemporaryDirectory folder;
  Names arguments{"plot",     WHIRL_TWIN_SOURCE "/config/scenes/" + scene + ".yaml",
                  "--system", system,
                  "--format", "json",
                  "--output", folder.file("")};
  arguments.insert(arguments.end(), options.begin(), options.end());
  const Ending end = twin(arguments);
  EXPECT_EQ(end.status, 0) << end.err;
  const std::string file = contentsOf(folder.file(system + "_" + kind + ".json"));
  return nlohmann::json::parse(file)["description"];
}

bool has(const std::string& text, const std::string& part) {
  return text.find(part) != std::string::npos;
}

// p / sqrt(1 - 2 zeta^2) = 60.15 rad/s, on the way up and on the way down.
TEST(Plot, MarksWhenTheShaftPassesItsCriticalSpeed) {
  const std::string words = wordsOf("demo", "rotor", "time");
  const std::size_t first = words.find("[critical, 60.15 rad/s at 10.0");
  ASSERT_NE(first, std::string::npos) << words;
  EXPECT_NE(words.find("[critical, 60.15 rad/s at 22.5", first), std::string::npos) << words;
}

// The critical speed of a rotor on its motor is that of the rotor with its shaft held: 200 rad/s.
TEST(Plot, MarksItWhereAMotorTurnsTheShaftToo) {
  EXPECT_TRUE(
      has(wordsOf("sommerfeld", "escaping", "time", {"--duration", "20"}), "[critical, 200"));
}

// On magnets they are those of the loop, which the rotor alone does not have.
TEST(Plot, MarksNoCriticalSpeedOfARotorThatAControllerHolds) {
  EXPECT_FALSE(has(wordsOf("levitation", "rotor", "time", {"--duration", "6"}), "[critical"));
}

TEST(Plot, ShowsTheSpeedOfAShaftInRpmToo) {
  EXPECT_TRUE(has(wordsOf("demo", "rotor", "time", {"--duration", "1"}),
                  "shaft speed (rad/s), rpm over time (s)"));
  // A motor turns it: its speed is a coordinate of the system.
  EXPECT_TRUE(has(wordsOf("sommerfeld", "captured", "time", {"--duration", "1"}),
                  "shaft speed (rad/s), rpm over time (s)"));
  // Not a rotor: its angle goes round and round.
  const std::string governor = wordsOf("governor", "engine", "time");
  EXPECT_TRUE(has(governor, "phi_rate (rad/s), rpm over")) << governor;
  EXPECT_TRUE(has(governor, "theta (rad) over")) << governor;
}

// A shaft that sags and does not whirl has no lag; where one whirls about the place where it hangs,
// radius and lag are those about that place.
TEST(Plot, ShowsALagWhereTheWhirlGoesWithTheShaft) {
  const std::string lag = "whirl phase lag (deg)";
  EXPECT_TRUE(has(wordsOf("demo", "rotor", "time"), lag));
  EXPECT_FALSE(has(wordsOf("hysteresis", "sagging", "time"), lag));
  const std::string hanging = wordsOf("levitation", "rotor", "time", {"--duration", "6"});
  EXPECT_TRUE(has(hanging, lag)) << hanging;
  EXPECT_TRUE(has(hanging, "whirl radius about its mean (m)")) << hanging;
}

// The largest whirl of this run is its last.
TEST(Plot, ShowsWholeTurnsOnly) {
  const std::string words = wordsOf("balancing", "rotor", "phase");
  EXPECT_TRUE(has(words, "7.11 s, ")) << words;
  EXPECT_FALSE(has(words, "e+")) << words;
}

struct Refused {
  Names options;
  std::string message;
};
class RefusedPlotOptions : public testing::TestWithParam<Refused> {};

TEST_P(RefusedPlotOptions, SayWhatWasExpected) {
  Names arguments{"plot", kDemo};
  arguments.insert(arguments.end(), GetParam().options.begin(), GetParam().options.end());
  const Ending end = twin(arguments);
  EXPECT_EQ(end.status, 2);
  EXPECT_EQ(end.out, "");
  EXPECT_EQ(end.err, GetParam().message + "\n");
}

INSTANTIATE_TEST_SUITE_P(
    Plot, RefusedPlotOptions,
    testing::Values(
        Refused{{"--format", "gif"}, "twin: --format: must be svg, png, pdf or json, found 'gif'"},
        Refused{{"--output", "/dev/null"}, "twin: --output: must be a folder, found '/dev/null'"},
        Refused{{"--duration", "-1"},
                "twin: --duration: must be from 0 s to 1000000000 s, found -1 s"},
        Refused{{"--system", "rotar"},
                "twin: --system: no system 'rotar' in " + kDemo + "; did you mean 'rotor'?"}));

TEST(Plot, MakesTheFolder) {
  const TemporaryDirectory folder;
  const Ending end = twin({"plot", kDemo, "--system", "pendulum", "--duration", "0.1", "--format",
                           "json", "--output", folder.file("report/pictures")});
  EXPECT_EQ(end.status, 0) << end.err;
  EXPECT_TRUE(std::filesystem::is_regular_file(folder.file("report/pictures/pendulum_time.json")));

  // It cannot be made, or nothing comes into it.
  EXPECT_EQ(twin({"plot", kDemo, "--output", "/proc/none"}).status, 1);
  EXPECT_EQ(twin({"plot", kDemo, "--duration", "1e9", "--output", folder.file("long/run")}).status,
            2);
  EXPECT_EQ(folder.files(), Names{"report"});
}

TEST(Plot, ThatCannotBeWrittenLeavesNothingBehind) {
  const TemporaryDirectory folder;
  // A folder has the last file's name.
  std::filesystem::create_directory(folder.file("pendulum_energy.json"));
  const Ending end =
      twin({"plot", kDemo, "--duration", "1", "--format", "json", "--output", folder.file("")});
  EXPECT_EQ(end.status, 1);
  EXPECT_EQ(end.out, "");
  EXPECT_EQ(folder.files(), Names{"pendulum_energy.json"});
}

TEST(Plot, OfASystemThatDivergesShowsItUntilThen) {
  const TemporaryDirectory folder;
  const std::string scene = folder.write("scene.yaml",
                                         "name: apart\n"
                                         "step: 0.01\n"
                                         "systems:\n"
                                         "  repelled:\n"
                                         "    model: linear_system\n"
                                         "    parameters: {mass: [[1]], stiffness: [[-1e8]]}\n"
                                         "    initial: {q1: 1.0}\n");
  const Ending end =
      twin({"plot", scene, "--duration", "1", "--format", "json", "--output", folder.file("")});
  EXPECT_EQ(end.status, 1) << end.out;
  EXPECT_NE(end.err.find("repelled: stopped in step"), std::string::npos) << end.err;
  EXPECT_EQ(folder.files(), (Names{"repelled_energy.json", "repelled_phase.json",
                                   "repelled_time.json", "scene.yaml"}));
}

}  // namespace plot_command_test
}  // namespace whirl_twin

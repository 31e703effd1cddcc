// Regression inputs for which `twin` once gave wrong results or hung: each gives finite numbers, or
// is rejected with an error text that names the error.
#include <gtest/gtest.h>
#include <malloc.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <filesystem>

#include "../tools/twin_program.h"

namespace whirl_twin {
namespace found_inputs_test {

const std::string kCorpus = WHIRL_TWIN_SOURCE "/tests/fuzz/corpus/";

bool contains(const std::string& text, const std::string& part) {
  return text.find(part) != std::string::npos;
}

bool hasControls(const std::string& text) {
  return std::any_of(text.begin(), text.end(),
                     [](unsigned char c) { return (c < 0x20 && c != '\n') || c == 0x7f; });
}

// 1e9 turns and more in a step leave no phase in a double, and do not fit the count of whole turns.
TEST(FoundInputs, AMotorThatTurnsTooFarInAStepStopsAndSaysWhy) {
  const Ending end = twin({"simulate", kCorpus + "motor_spin_beyond_int64.yaml", "--duration",
                           "0.05", "--integrator", "dormand_prince_8", "--json"});
  EXPECT_EQ(end.status, 1);
  const auto a = end.json()["systems"]["a"];
  EXPECT_EQ(a["status"], "the speed of its shaft is outside the prepared range");
}

TEST(FoundInputs, AMassWhoseInverseOverflowsIsRefused) {
  const Ending end =
      twin({"simulate", kCorpus + "mass_too_small.yaml", "--duration", "0.01", "--json"});
  EXPECT_EQ(end.status, 2);
  EXPECT_TRUE(contains(end.err, "systems.a.parameters: together give a fastest rate of inf 1/s"))
      << end.err;
}

TEST(FoundInputs, AHorizonThatIsNoDurationIsNotRun) {
  const Ending end = twin({"tradeoff", kCorpus + "tradeoff_horizon.yaml"});
  EXPECT_EQ(end.status, 2);
  EXPECT_EQ(end.out, "");
  EXPECT_TRUE(contains(end.err, "a: the horizon, 1e+10 s, is outside")) << end.err;
}

// A horizon of 1e300 s is known as far as a budget of evaluations goes, and no number overflows.
TEST(FoundInputs, ACalibrationOverAnEndlessHorizonSaysHowFarItIsKnown) {
  const Ending end = twin({"check", kCorpus + "calibration_at_rest.yaml"});
  EXPECT_EQ(end.status, 0) << end.err;
  EXPECT_FALSE(contains(end.out, "nan")) << end.out;
  EXPECT_TRUE(contains(end.out, "unknown after ")) << end.out;
}

TEST(FoundInputs, AMotionOfTheSmallestDoublesIsDrawn) {
  const TemporaryDirectory folder;
  const Ending end = twin(
      {"plot", kCorpus + "plot_flat_axis.yaml", "--duration", "0.05", "--output", folder.file("")});
  EXPECT_EQ(end.status, 0) << end.err;
  EXPECT_EQ(folder.files(), (Lines{"a_energy.svg", "a_phase.svg", "a_picture.svg", "a_time.svg"}));
}

/// An event of a log at this time [us], with one byte on the channel X.
std::string logEvent(std::uint64_t timestamp, char number) {
  std::string event("\xed\xa1\xda\x01\0\0\0\0\0\0\0", 11);
  event += number;
  for (int shift = 56; shift >= 0; shift -= 8) {
    event += static_cast<char>(timestamp >> shift & 0xffu);
  }
  return event + std::string("\0\0\0\1\0\0\0\1Xx", 10);
}

TEST(FoundInputs, TimestampsAtTheEndsOf64BitsAreDamage) {
  const TemporaryDirectory folder;
  const std::string log = folder.write(
      "span.lcmlog", logEvent(0x8000000000000000u, 0) + logEvent(0x7fffffffffffffffu, 1));
  const Ending end = twin({"log", log, "--json"});
  EXPECT_EQ(end.status, 1);
  EXPECT_EQ(end.json()["events"], 2);
  EXPECT_EQ(end.json()["corrupt"], 2);
  EXPECT_NEAR(end.json()["span"].get<double>(), 0x1p64 * 1.0e-6, 1.0e-3);
}

TEST(FoundInputs, RunsThatOverflowAreRefusedByNumber) {
  const std::string file = kCorpus + "balance_overflow.yaml";
  const Ending end = twin({"balance", "--json", file});
  EXPECT_EQ(end.status, 2);
  EXPECT_EQ(end.out, "");
  EXPECT_EQ(end.err, "twin: " + file +
                         ": trials[0].mass_radius: must be mass times radius in kg m, from -1e+12 "
                         "to 1e+12, found 1e200\n");
}

TEST(FoundInputs, ATrialMassTooSmallToBeOneNamesItsPlane) {
  const std::string file = kCorpus + "balance_underflow.yaml";
  const Ending end = twin({"balance", file});
  EXPECT_EQ(end.status, 2);
  EXPECT_EQ(end.err, "twin: " + file +
                         ": trials[0].mass_radius: must be 1e-12 kg m at least, found 1e-200 in "
                         "plane 'l'\n");
}

TEST(FoundInputs, TwinProbesAndMisspeltKeysOfRunsAreNamedTogether) {
  const std::string file = kCorpus + "balance_twins.yaml";
  const Ending end = twin({"balance", "--json", file});
  EXPECT_EQ(end.status, 2);
  EXPECT_EQ(end.err, "twin: " + file +
                         ": weigths: unknown key of a balancing job; did you mean 'weights'?\n"
                         "twin: " +
                         file + ": probes[1]: must be unique, found 'p' twice\n");
}

TEST(FoundInputs, ANameIsShownAndNotObeyed) {
  const Ending end = twin({"check", kCorpus + "name_escapes.yaml"});
  EXPECT_EQ(end.status, 0) << end.err;
  EXPECT_FALSE(hasControls(end.out));
  EXPECT_TRUE(
      contains(linesOf(end.out).front(),
               "scene 'x\\x1b[2J\\x1b[31mred\\x0asound.yaml: scene 'other' is sound' is valid"))
      << end.out;
}

TEST(FoundInputs, ATopicIsShownOnOneLine) {
  const std::string folder = testing::TempDir() + "found_topic_" + std::to_string(::getpid());
  const Ending end = twin({"export", "--csv", folder, kCorpus + "topic_with_a_line_break.bag"});
  EXPECT_EQ(end.status, 0) << end.err;
  EXPECT_EQ(linesOf(end.out).size(), 2u) << end.out;
  EXPECT_TRUE(contains(end.out, "  /a\\x0a/twin/rotor/whirl  1000 messages, all sound")) << end.out;
  std::filesystem::remove_all(folder);
}

TEST(FoundInputs, ACommentIsShownAndNotObeyed) {
  const Ending end = twin({"scenes", kCorpus + "comment_escapes"});
  EXPECT_EQ(end.status, 0) << end.err;
  EXPECT_FALSE(hasControls(end.out));
  EXPECT_TRUE(contains(end.out, "What \\x1b[2J\\x1b[31m to watch")) << end.out;
}

// The eigenvalues decide where they can; exact numbers only near the boundary.
TEST(FoundInputs, AShaftOfUnequalElementsIsAnalysed) {
  const Ending end = twin({"analyze", kCorpus + "analyze_exact_routh.yaml", "--json"});
  EXPECT_EQ(end.status, 0) << end.err;
}

TEST(FoundInputs, ExactTestsThatWouldNotEndAreUncertain) {
  const Ending strange = twin({"routh", "--json", "--", "2914", "i", "3", "1+1e5000i", "1e-5",
                               "-1e-3", "0", "5e-5000", "2", "1e-3", "5", "-9e5000"});
  EXPECT_TRUE(strange.status == 2 || strange.json()["verdict"] == "uncertain") << strange.out;
  Lines many{"routh", "--json"};
  for (int k = 0; k <= 400; ++k) {
    many.push_back(k % 2 == 0 ? "1" : "0");
  }
  const Ending end = twin(many);
  ASSERT_EQ(end.status, 0) << end.err;
  EXPECT_EQ(end.json()["verdict"], "uncertain");
  // s^400 + s^398 + ... + 1: the roots are those of s^402 = 1 but s = 1 and s = -1.
  EXPECT_EQ(end.json()["right"], 200);
  EXPECT_EQ(end.json()["left"], 200);
}

TEST(FoundInputs, ARootBeyondDoubleIsRefused) {
  const Ending end = twin({"routh", "--json", "1", "1e309"});
  EXPECT_EQ(end.status, 2);
  EXPECT_EQ(end.out, "");
  EXPECT_TRUE(contains(end.err, "a root exceeds 1.8e308")) << end.err;
}

// 404 coordinates, whose steps over speed are some hundred exponentials of a matrix of 800 rows.
TEST(FoundInputs, AShaftWhoseStepsTakeMinutesIsCheckedWithoutThem) {
  const Ending end = twin({"check", kCorpus + "shaft_unreduced.yaml"});
  EXPECT_EQ(end.status, 0) << end.err;
  EXPECT_TRUE(contains(end.out, "not calibrated: its steps take long to prepare"));
  EXPECT_TRUE(contains(end.out, "a step costs  not measured: preparing its steps takes about "))
      << end.out;
}

TEST(FoundInputs, AMillionSubstepsAreChecked) {
  const Ending end = twin({"check", kCorpus + "substeps_million.yaml", "--json"});
  EXPECT_EQ(end.status, 0) << end.err;
  EXPECT_EQ(end.json()["systems"]["a"]["substeps"], 1000000);
}

TEST(FoundInputs, ARunOfMoreThanADayIsRefusedByItsNumbers) {
  const TemporaryDirectory folder;
  const Lines asked{"simulate",   kCorpus + "substeps_million.yaml",
                    "--duration", "1000000",
                    "--output",   folder.file("run.csv")};
  const Ending end = twin(asked);
  EXPECT_EQ(end.status, 2);
  EXPECT_TRUE(contains(end.err,
                       "--duration: 1000000 s in 1000000000 steps, 1000000 substeps each: takes "
                       "about "))
      << end.err;
  EXPECT_TRUE(contains(end.err, "with --insist")) << end.err;
  EXPECT_EQ(folder.files(), Lines{});
}

TEST(FoundInputs, MoreMembersThanADayOrTheMemoryHoldsAreRefusedByTheirNumber) {
  if (::mallinfo2().uordblks == 0) {
    GTEST_SKIP() << "a sanitizer's memory is not counted";
  }
  std::string scene = contentsOf(kCorpus + "members_of_a_shaft.yaml");
  scene.replace(scene.find("count: 1000"), 11, "count: 100000");
  scene.replace(scene.find("modes: 8"), 8, "modes: 24");
  const TemporaryDirectory folder;
  for (const char* command : {"check", "simulate"}) {
    const Ending end = twin({command, folder.write("scene.yaml", scene)});
    EXPECT_EQ(end.status, 2) << command;
    EXPECT_EQ(end.out, "");
    EXPECT_TRUE(contains(end.err, "rotor: count: 100000: takes about ")) << end.err;
  }
}

TEST(FoundInputs, RootsThatTakeMoreThanADayAreRefusedByTheirNumber) {
  Lines many(50000, "1+i");
  many.insert(many.begin(), {"routh", "--json"});
  const Ending end = twin(many);
  EXPECT_EQ(end.status, 2);
  EXPECT_EQ(end.out, "");
  EXPECT_TRUE(contains(end.err, "50000 coefficients: takes about ")) << end.err;
}

/// Files without text or events, given to every reader.
TEST(FoundInputs, FoldersDevicesAndPipesAreNoFiles) {
  const TemporaryDirectory folder;
  const std::string pipe = folder.file("pipe");
  ASSERT_EQ(::mkfifo(pipe.c_str(), 0600), 0);
  for (const std::string& path : {folder.file("."), std::string("/dev/zero"), pipe}) {
    const auto expectRefused = [&](const Lines& arguments) {
      const Ending end = twin(arguments);
      EXPECT_EQ(end.status, 2) << arguments.front() << ' ' << path;
      EXPECT_EQ(end.out, "");
      EXPECT_TRUE(contains(end.err, path)) << end.err;
    };
    for (const char* command : {"check", "simulate", "plot", "analyze", "campbell", "response",
                                "tradeoff", "balance", "log", "fit"}) {
      expectRefused({command, path});
    }
    const std::string scene = WHIRL_TWIN_SOURCE "/config/scenes/demo.yaml";
    expectRefused({"monitor", scene, path});
    expectRefused({"monitor", scene, "no.lcmlog", "--settings", path});
  }
}

}  // namespace found_inputs_test
}  // namespace whirl_twin

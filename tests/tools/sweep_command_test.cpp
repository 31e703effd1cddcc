#include <gtest/gtest.h>
#include <sys/resource.h>

#include <chrono>
#include <cmath>
#include <csignal>
#include <cstdio>
#include <cstdlib>
#include <random>
#include <thread>

#include "swept_study.h"

namespace whirl_twin {
namespace sweep_command_test {

TEST(Sweep, WorkersPartsAndBreaksChangeNoByte) {
  const StudyFiles files;
  const Ending one = files.sweep("one", {"--workers", "1"});
  ASSERT_EQ(one.status, 0) << one.err;
  const std::string all = files.results("one");
  EXPECT_EQ(linesOf(contentsOf(files.file("one/results.csv"))).size() +
                linesOf(contentsOf(files.file("one/failed.csv"))).size(),
            302U);
  for (const std::string workers : {"2", "4"}) {
    const Ending ending = files.sweep("of" + workers, {"--workers", workers});
    EXPECT_EQ(ending.out, one.out);
    EXPECT_EQ(files.results("of" + workers), all);
  }
  for (const std::string part : {"3/3", "1/3"}) {
    const Ending ending = files.sweep("parts", {"--part", part});
    EXPECT_EQ(ending.status, 0) << ending.err;
    EXPECT_NE(ending.out.find(" of 300 points"), std::string::npos);
  }
  const Ending missing = files.sweep("parts", {"--merge"});
  EXPECT_EQ(missing.status, 1);
  EXPECT_NE(missing.err.find("200 of 300 points are done"), std::string::npos) << missing.err;
  EXPECT_EQ(files.sweep("parts", {"--part", "2/3"}).out, one.out);
  EXPECT_EQ(files.sweep("parts", {"--merge"}).out, one.out);
  EXPECT_EQ(files.results("parts"), all);
}

// Killed 12 times at any moment of a run, its start and its end; 100 times with
// WHIRL_TWIN_EXTREMES=full.
TEST(Sweep, KilledAnyTimeItGoesOnAndLosesNothing) {
  const StudyFiles files;
  ASSERT_EQ(files.sweep("whole").status, 0);
  const char* const length = std::getenv("WHIRL_TWIN_EXTREMES");
  const int kills = length != nullptr && std::string(length) == "full" ? 100 : 12;
  std::mt19937 random(1);
  int folders = 0;
  for (int killed = 0; killed < kills;) {
    const std::string folder = "killed" + std::to_string(folders);
    const pid_t child = startTwin({"sweep", files.study, "--output", files.file(folder)},
                                  files.file("out"), files.file("err"));
    std::this_thread::sleep_for(std::chrono::milliseconds(random() % 250));
    ::kill(child, random() % 5 == 0 ? SIGINT : SIGKILL);
    const int status = statusOf(child);
    killed += status == -SIGKILL ? 1 : 0;
    if (status == 0 || killed == kills) {
      const Ending last = files.sweep(folder);
      EXPECT_EQ(last.status, 0) << last.err;
      EXPECT_EQ(files.results(folder), files.results("whole"));
      std::size_t blocks = 0;
      for (const auto& entry :
           std::filesystem::directory_iterator(files.file(folder) + "/blocks")) {
        EXPECT_EQ(entry.path().extension(), ".csv");
        ++blocks;
      }
      EXPECT_EQ(blocks, 30U);
      ++folders;
    }
  }
}

// As docs/studies.md has it for one machine.
TEST(Sweep, PartsThatXargsStartsAtOnceAreOneStudy) {
  const StudyFiles files;
  ASSERT_EQ(files.sweep("whole").status, 0);
  const std::string command = "seq 5 | xargs -P 3 -I{} " WHIRL_TWIN_PROGRAM " sweep " +
                              files.study + " --output " + files.file("parts") +
                              " --workers 1 --part {}/5 >" + files.file("out");
  EXPECT_EQ(std::system(command.c_str()), 0);
  EXPECT_EQ(files.results("parts"), files.results("whole"));
}

TEST(Sweep, ADamagedBlockIsRunAgain) {
  const StudyFiles files;
  ASSERT_EQ(files.sweep("r").status, 0);
  const std::string all = files.results("r");
  const std::string block = files.file("r") + "/blocks/000000003.csv";
  const std::string text = contentsOf(block);
  std::ofstream(block, std::ios::binary) << text.substr(0, text.size() / 2);
  ASSERT_EQ(files.sweep("r").status, 0);
  EXPECT_EQ(files.results("r"), all);
}

// Any digit of it, with the same number of bytes.
TEST(Sweep, ABlockWithAnotherDigitIsRunAgain) {
  const StudyFiles files;
  ASSERT_EQ(files.sweep("r").status, 0);
  const std::string all = files.results("r");
  const std::string block = files.file("r") + "/blocks/000000003.csv";
  const std::string text = contentsOf(block);
  for (const std::size_t at : {text.find('.') + 1, text.size() / 2, text.rfind('.') + 1}) {
    std::string other = text;
    other[at] = other[at] == '7' ? '3' : '7';
    std::ofstream(block, std::ios::binary) << other;
    ASSERT_EQ(files.sweep("r").status, 0);
    EXPECT_EQ(files.results("r"), all);
    EXPECT_EQ(contentsOf(block), text);
  }
}

TEST(Sweep, DistributionsAndListsAreCheckedBeforeTheyAreUsed) {
  for (const char* const values :
       {"{list: []}", "{list: [x]}", "{list: [[1]]}", "{list: {a: 1}}", "{list: [1, x]}",
        "{grid: []}", "{uniform: []}", "{}", "[]", "{uniform: [2, 1]}", "{normal: [1]}",
        "{log_uniform: [0, 1]}", "{relative_half_width: x}", "{relative_half_width: 1e308}"}) {
    for (const char* const what : {"optimize: {minimize: p}", "design: grid", "design: list",
                                   "design: {morris: 2}", "design: {sobol_indices: 2}"}) {
      const StudyFiles files(std::string("study: {scene: scene.yaml}\nvary: {rotor.stiffness: ") +
                             values + "}\n" + what +
                             "\nrun: {duration: 0.1}\nmeasure: {p: max(rotor.whirl.radius)}\n");
      const Ending ending = files.sweep("r");
      EXPECT_EQ(ending.status, 2) << values << ", " << what;
      EXPECT_NE(ending.err.find("rotor.stiffness"), std::string::npos) << ending.err;
    }
  }
}

TEST(Sweep, WhatNoMachineCanRunIsRefusedAtOnce) {
  const auto study = [](const std::string& block, const std::string& points) {
    return "study: {scene: scene.yaml" + block +
           "}\nvary: {rotor.stiffness: {uniform: [0.9e4, 1.1e4]}}\ndesign: {monte_carlo: " +
           points + "}\nrun: analyze\nmeasure: {f: \"natural_frequencies[0]\"}\n";
  };
  const auto begun = std::chrono::steady_clock::now();
  const Ending many = StudyFiles(study("", "1000000000000")).sweep("r");
  EXPECT_EQ(many.status, 2);
  EXPECT_NE(many.err.find("from 1 to 1e+09"), std::string::npos) << many.err;
  const Ending blocks = StudyFiles(study(", block: 1", "2000000")).sweep("r");
  EXPECT_EQ(blocks.status, 2);
  EXPECT_NE(blocks.err.find("study.block: must be at least 2"), std::string::npos) << blocks.err;
  EXPECT_LT(std::chrono::steady_clock::now() - begun, std::chrono::seconds(2));
}

// If the signal is not polled, in one long step of the work, the program ends all the same.
TEST(Sweep, EndsWithinASecondOfASignal) {
  for (const int signal : {SIGINT, SIGTERM}) {
    const StudyFiles files(R"(
study: {scene: scene.yaml, block: 1}
vary: {rotor.stiffness: {uniform: [0.9e4, 1.1e4]}}
design: {monte_carlo: 100000}
run: {duration: 2.0, analyze: true}
measure: {peak: max(rotor.whirl.radius), f: "natural_frequencies[0]"}
)");
    const pid_t child = startTwin({"sweep", files.study, "--output", files.file("r"), "--insist"},
                                  files.file("out"), files.file("err"));
    std::this_thread::sleep_for(std::chrono::milliseconds(700));
    const auto begun = std::chrono::steady_clock::now();
    ::kill(child, signal);
    EXPECT_EQ(statusOf(child), 1);
    EXPECT_LT(std::chrono::steady_clock::now() - begun, std::chrono::seconds(1));
    EXPECT_NE(contentsOf(files.file("err")).find("interrupted"), std::string::npos);
    EXPECT_FALSE(files.blocks("r").empty());
  }
}

TEST(Sweep, FailedPointsAreRecordedAndRunAlone) {
  const StudyFiles files;
  const Ending ending = files.sweep("r", {"--json"});
  ASSERT_EQ(ending.status, 0) << ending.err;
  const nlohmann::json said = ending.json();
  const Lines failed = linesOf(contentsOf(files.file("r") + "/failed.csv"));
  ASSERT_GT(failed.size(), 10U);
  EXPECT_EQ(said["failed"], failed.size() - 1);
  EXPECT_EQ(failed[0], "point,reason,rotor.stiffness,rotor.damping");
  EXPECT_NE(failed[1].find("must be >= 0 N s/m"), std::string::npos) << failed[1];
  const std::string point = failed[1].substr(0, failed[1].find(','));
  const Ending alone = twin({"sweep", files.study, "--point", point, "--json"});
  EXPECT_EQ(alone.status, 1);
  EXPECT_NE(alone.json()["failure"].get<std::string>().find("must be >= 0"), std::string::npos);
  const Lines good = linesOf(contentsOf(files.file("r") + "/results.csv"));
  const std::string first = good[1].substr(0, good[1].find(','));
  const nlohmann::json again =
      twin({"sweep", files.study, "--output", files.file("r"), "--point", first, "--json"}).json();
  EXPECT_NE(good[1].find("," + again["measures"]["peak"].dump() + ","), std::string::npos)
      << good[1] << " " << again;
}

TEST(Sweep, WhereAllPointsFailItSaysSo) {
  const StudyFiles files(R"(
study: {scene: scene.yaml}
vary: {rotor.damping: {normal: [-100.0, 1.0]}}
design: {monte_carlo: 20}
run: analyze
measure: {frequency: "natural_frequencies[0]"}
require: {frequency: "> 1"}
)");
  const Ending ending = files.sweep("r", {"--json"});
  EXPECT_EQ(ending.status, 1);
  EXPECT_EQ(ending.json()["failed"], 20);
  EXPECT_TRUE(ending.json()["measures"]["frequency"]["mean"].is_null());
  EXPECT_EQ(ending.json()["yield"]["passed"], 0);
}

TEST(Sweep, StopsAtAFailureWhereThatIsAskedFor) {
  const StudyFiles files("study: {scene: scene.yaml, on_failure: stop}" +
                         kStudyOfBlocks.substr(kStudyOfBlocks.find("\nvary")));
  const Ending ending = files.sweep("r");
  EXPECT_EQ(ending.status, 1);
  EXPECT_NE(ending.err.find("point "), std::string::npos);
  EXPECT_NE(ending.err.find("must be >= 0"), std::string::npos) << ending.err;
}

TEST(Sweep, AnotherStudyIsNotMixedIn) {
  const StudyFiles files;
  ASSERT_EQ(files.sweep("r").status, 0);
  files.write("study.yaml", kStudyOfBlocks + "# another\n");
  const Ending other = files.sweep("r");
  EXPECT_EQ(other.status, 2);
  EXPECT_NE(other.err.find("another study"), std::string::npos) << other.err;
  files.write("study.yaml", kStudyOfBlocks);
  files.write("scene.yaml", kStudiedRotor + "gravity: 1.0\n");
  EXPECT_EQ(files.sweep("r").status, 2);
  files.write("scene.yaml", kStudiedRotor);
  const std::string manifest = files.file("r") + "/manifest.yaml";
  const std::string text = contentsOf(manifest);
  const std::size_t at = text.find("compiler: ") + 10;
  std::ofstream(manifest) << text.substr(0, at) << "other" << text.substr(text.find('\n', at));
  const Ending mixed = files.sweep("r");
  EXPECT_EQ(mixed.status, 2);
  EXPECT_NE(mixed.err.find("--mixed"), std::string::npos) << mixed.err;
  EXPECT_EQ(files.sweep("r", {"--mixed"}).status, 0);
}

TEST(Sweep, WhatCannotBeWrittenIsSaidAndWhatWasFinishedStays) {
  const StudyFiles files;
  files.write("taken", "a file");
  EXPECT_EQ(files.sweep("taken").status, 1);
  EXPECT_EQ(twin({"sweep", files.study, "--output", "/proc/none/here"}).status, 1);
  // No file may grow beyond 4 kB: blocks do not, results.csv does, as on a disk that is full.
  rlimit before{};
  ::getrlimit(RLIMIT_FSIZE, &before);
  rlimit little = before;
  little.rlim_cur = 4096;
  ::setrlimit(RLIMIT_FSIZE, &little);
  const pid_t child = startTwin({"sweep", files.study, "--output", files.file("full")},
                                files.file("out"), files.file("err"));
  const int status = statusOf(child);
  ::setrlimit(RLIMIT_FSIZE, &before);
  EXPECT_EQ(status, 1);
  EXPECT_NE(contentsOf(files.file("err")).find("results.csv: cannot be written"), std::string::npos)
      << contentsOf(files.file("err"));
  EXPECT_EQ(files.sweep("full", {"--status", "--json"}).json()["done"], 300);
  ASSERT_EQ(files.sweep("whole").status, 0);
  EXPECT_EQ(files.sweep("full", {"--merge"}).status, 0);
  EXPECT_EQ(files.results("full"), files.results("whole"));
}

/// A study swept on a private file system, mounted in a namespace of the test.
class SweepOnADisk : public testing::Test {
 protected:
  void SetUp() override {
    if (inPrivateMounts("true") != 0) {
      GTEST_SKIP() << "no mount namespaces here";
    }
    std::filesystem::create_directory(disk_);
    ASSERT_EQ(files_.sweep("whole").status, 0);
  }
  /// A shell's exit status; `commands` may mount.
  static int inPrivateMounts(const std::string& commands) {
    const int ended =
        std::system(("unshare --mount --map-root-user bash -c '" + commands + "'").c_str());
    return WIFEXITED(ended) ? WEXITSTATUS(ended) : -1;
  }
  /// On a disk mounted with `options` a part is done; then it is remounted with others, and a sweep
  /// reports why it cannot write, and the exit status; then with enough space for all of it.
  void expectRefusedThenWhole(const std::string& options, const std::string& before,
                              const std::string& refusing, const std::string& inputError,
                              const std::string& roomy) {
    const std::string status = files_.file("status");
    const std::string said = files_.file("said");
    EXPECT_EQ(inPrivateMounts("mount -t tmpfs -o " + options + " none " + disk_ + " && { " +
                              before + "; mount -o remount," + refusing + " " + disk_ + "; " +
                              sweep_ + ">/dev/null 2>" + said + "; echo $? >" + status + "; " +
                              sweep_ + "--status >" + files_.file("told") + "; mount -o remount," +
                              roomy + " " + disk_ + " && " + sweep_ + ">/dev/null && cp -r " +
                              disk_ + "/r " + files_.file("after") + "; }"),
              0);
    EXPECT_EQ(contentsOf(status), "1\n");
    EXPECT_NE(
        contentsOf(said).find("cannot be written: " + inputError + "; the previous file is kept"),
        std::string::npos)
        << contentsOf(said);
    EXPECT_EQ(files_.results("after"), files_.results("whole"));
  }

  StudyFiles files_;
  std::string disk_ = files_.file("disk");
  std::string sweep_ = WHIRL_TWIN_PROGRAM " sweep " + files_.study + " --output " + disk_ + "/r ";
};

// Of 64 kB, with space for some of the 30 blocks; then it grows.
TEST_F(SweepOnADisk, ThatIsFullItSaysSoAndWhatWasFinishedStays) {
  expectRefusedThenWhole("size=64k", "true", "size=64k", "No space left on device", "size=16m");
  int done = 0;
  EXPECT_EQ(std::sscanf(contentsOf(files_.file("told")).c_str(), "%d of 300", &done), 1);
  EXPECT_GT(done, 30);
  EXPECT_LT(done, 300);
}

// When a third of it has been run it is one that is only read; then it is not.
TEST_F(SweepOnADisk, ThatIsOnlyReadItSaysSoAndWhatWasFinishedStays) {
  expectRefusedThenWhole("size=16m", sweep_ + "--part 1/3 >/dev/null", "ro",
                         "Read-only file system", "rw");
  EXPECT_EQ(contentsOf(files_.file("told")).rfind("100 of 300 points", 0), 0U);
}

TEST(Sweep, AFolderThatGoesIsNoticedAndGoesOnElsewhere) {
  const StudyFiles files("study: {scene: scene.yaml, block: 1}\n" +
                         std::string(kStudyOfBlocks)
                             .replace(kStudyOfBlocks.find("300"), 3, "500")
                             .substr(kStudyOfBlocks.find("\nvary")));
  const pid_t child = startTwin({"sweep", files.study, "--output", files.file("gone")},
                                files.file("out"), files.file("err"));
  while (!std::filesystem::exists(files.file("gone") + "/blocks/000000003.csv")) {
    std::this_thread::sleep_for(std::chrono::milliseconds(1));
  }
  std::filesystem::rename(files.file("gone"), files.file("elsewhere"));
  EXPECT_EQ(statusOf(child), 1);
  EXPECT_NE(contentsOf(files.file("err")).find("cannot be written: No such file"),
            std::string::npos)
      << contentsOf(files.file("err"));
  ASSERT_EQ(files.sweep("elsewhere").status, 0);
  ASSERT_EQ(files.sweep("whole").status, 0);
  EXPECT_EQ(files.results("elsewhere"), files.results("whole"));
}

TEST(Sweep, ThoseWhoBeginAtOnceShareAFolder) {
  const StudyFiles files;
  for (int k = 0; k < 5; ++k) {
    const std::string folder = files.file("r" + std::to_string(k));
    std::vector<pid_t> parts;
    for (const std::string part : {"1/4", "2/4", "3/4", "4/4"}) {
      parts.push_back(startTwin({"sweep", files.study, "--output", folder, "--part", part},
                                files.file("out" + part.substr(0, 1)), files.file("err")));
    }
    for (const pid_t part : parts) {
      EXPECT_EQ(statusOf(part), 0) << contentsOf(files.file("err"));
    }
    for (const auto& entry : std::filesystem::directory_iterator(folder)) {
      EXPECT_NE(entry.path().extension(), ".tmp") << entry.path();
    }
  }
}

TEST(Sweep, OptionsThatCannotBeMeantAreRefused) {
  const StudyFiles files;
  EXPECT_EQ(twin({"sweep", files.study}).status, 2);
  EXPECT_EQ(files.sweep("r", {"--part", "0/3"}).status, 2);
  EXPECT_EQ(files.sweep("r", {"--part", "4/3"}).status, 2);
  EXPECT_EQ(files.sweep("r", {"--part", "1/3x"}).status, 2);
  EXPECT_EQ(files.sweep("r", {"--point", "300"}).status, 2);
  EXPECT_EQ(files.sweep("none", {"--status"}).status, 2);
  EXPECT_EQ(files.sweep("none", {"--merge"}).status, 2);
  EXPECT_EQ(twin({"sweep", files.file("none.yaml"), "--output", "x"}).status, 2);
  EXPECT_FALSE(std::filesystem::exists(files.file("r")));
}

}  // namespace sweep_command_test
}  // namespace whirl_twin

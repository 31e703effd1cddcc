#include <gtest/gtest.h>
#include <sys/resource.h>

#include <cmath>
#include <csignal>
#include <cstdlib>
#include <random>
#include <thread>

#include "twin_program.h"

namespace whirl_twin {
namespace {

const std::string kScene = R"(
step: 0.001
systems:
  rotor:
    model: jeffcott_rotor
    drive: shaft
    parameters: {mass: 1.0, stiffness: 1.0e4, damping: 10.0, eccentricity: 1.0e-4}
drives: {shaft: {speed: 90.0}}
)";

/// A study of 300 points in 30 blocks, one in ten of which is refused.
const std::string kStudy = R"(
study: {scene: scene.yaml, seed: 3, block: 10}
vary:
  rotor.stiffness: {uniform: [0.9e4, 1.1e4]}
  rotor.damping: {normal: [10.0, 7.8]}
design: {latin_hypercube: 300}
run: {duration: 0.3}
measure: {peak: max(rotor.whirl.radius), frequency: "natural_frequencies[0]"}
require: {peak: "< 4.0e-4"}
)";

struct Files : TemporaryDirectory {
  std::string study;
  explicit Files(const std::string& text = kStudy) {
    write("scene.yaml", kScene);
    study = write("study.yaml", text);
  }
  Ending sweep(const std::string& folder, const std::vector<std::string>& more = {}) const {
    std::vector<std::string> arguments{"sweep", study, "--output", file(folder)};
    arguments.insert(arguments.end(), more.begin(), more.end());
    return twin(arguments);
  }
  std::string results(const std::string& folder) const {
    return contentsOf(file(folder) + "/results.csv") + contentsOf(file(folder) + "/failed.csv");
  }
};

TEST(Sweep, WorkersPartsAndBreaksChangeNoByte) {
  const Files files;
  const Ending one = files.sweep("one", {"--workers", "1"});
  ASSERT_EQ(one.status, 0) << one.err;
  const std::string all = files.results("one");
  EXPECT_EQ(linesOf(all).size(), 302U);
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

// 12 times at any moment of a run, of its start and of what it does at its end; 100 times with
// WHIRL_TWIN_EXTREMES=full.
TEST(Sweep, KilledAnyTimeItGoesOnAndLosesNothing) {
  const Files files;
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
  const Files files;
  ASSERT_EQ(files.sweep("whole").status, 0);
  const std::string command = "seq 5 | xargs -P 3 -I{} " WHIRL_TWIN_PROGRAM " sweep " +
                              files.study + " --output " + files.file("parts") +
                              " --workers 1 --part {}/5 >" + files.file("out");
  EXPECT_EQ(std::system(command.c_str()), 0);
  EXPECT_EQ(files.results("parts"), files.results("whole"));
}

TEST(Sweep, ADamagedBlockIsRunAgain) {
  const Files files;
  ASSERT_EQ(files.sweep("r").status, 0);
  const std::string all = files.results("r");
  const std::string block = files.file("r") + "/blocks/000000003.csv";
  const std::string text = contentsOf(block);
  std::ofstream(block, std::ios::binary) << text.substr(0, text.size() / 2);
  ASSERT_EQ(files.sweep("r").status, 0);
  EXPECT_EQ(files.results("r"), all);
}

TEST(Sweep, FailedPointsAreRecordedAndRunAlone) {
  const Files files;
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
  const Files files(R"(
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
  const Files files("study: {scene: scene.yaml, on_failure: stop}" +
                    kStudy.substr(kStudy.find("\nvary")));
  const Ending ending = files.sweep("r");
  EXPECT_EQ(ending.status, 1);
  EXPECT_NE(ending.err.find("point "), std::string::npos);
  EXPECT_NE(ending.err.find("must be >= 0"), std::string::npos) << ending.err;
}

TEST(Sweep, AnotherStudyIsNotMixedIn) {
  const Files files;
  ASSERT_EQ(files.sweep("r").status, 0);
  files.write("study.yaml", kStudy + "# another\n");
  const Ending other = files.sweep("r");
  EXPECT_EQ(other.status, 2);
  EXPECT_NE(other.err.find("another study"), std::string::npos) << other.err;
  files.write("study.yaml", kStudy);
  files.write("scene.yaml", kScene + "gravity: 1.0\n");
  EXPECT_EQ(files.sweep("r").status, 2);
  files.write("scene.yaml", kScene);
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
  const Files files;
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

/// A shell's exit status; `commands` may mount, and nobody else sees it.
int inPrivateMounts(const std::string& commands) {
  const int ended =
      std::system(("unshare --mount --map-root-user bash -c '" + commands + "'").c_str());
  return WIFEXITED(ended) ? WEXITSTATUS(ended) : -1;
}

// A file system of 64 kB, which has room for some of the 30 blocks; then it grows.
TEST(Sweep, ADiskThatIsFullIsSaidAndWhatWasFinishedStays) {
  if (inPrivateMounts("true") != 0) {
    GTEST_SKIP() << "no mount namespaces here";
  }
  const Files files;
  ASSERT_EQ(files.sweep("whole").status, 0);
  const std::string disk = files.file("disk");
  std::filesystem::create_directory(disk);
  const std::string sweep =
      WHIRL_TWIN_PROGRAM " sweep " + files.study + " --output " + disk + "/r >/dev/null ";
  EXPECT_EQ(
      inPrivateMounts("mount -t tmpfs -o size=64k none " + disk + " && { " + sweep + "2>" +
                      files.file("full") + "; echo $? >" + files.file("status") + "; ls " + disk +
                      "/r/blocks >" + files.file("blocks") + "; mount -o remount,size=16m " + disk +
                      " && " + sweep + "&& cp -r " + disk + "/r " + files.file("after") + "; }"),
      0);
  EXPECT_EQ(contentsOf(files.file("status")), "1\n");
  EXPECT_NE(
      contentsOf(files.file("full"))
          .find("cannot be written: No space left on device; what was finished before is kept"),
      std::string::npos)
      << contentsOf(files.file("full"));
  const Lines blocks = linesOf(contentsOf(files.file("blocks")));
  EXPECT_GT(blocks.size(), 3U);
  EXPECT_LT(blocks.size(), 30U);
  EXPECT_EQ(files.results("after"), files.results("whole"));
}

// When a third of it has been run the file system is one that is only read; then it is not.
TEST(Sweep, AFolderThatIsOnlyReadIsSaidAndWhatWasFinishedStays) {
  if (inPrivateMounts("true") != 0) {
    GTEST_SKIP() << "no mount namespaces here";
  }
  const Files files;
  ASSERT_EQ(files.sweep("whole").status, 0);
  const std::string disk = files.file("disk");
  std::filesystem::create_directory(disk);
  const std::string sweep =
      WHIRL_TWIN_PROGRAM " sweep " + files.study + " --output " + disk + "/r ";
  EXPECT_EQ(
      inPrivateMounts("mount -t tmpfs none " + disk + " && { " + sweep +
                      "--part 1/3 >/dev/null; mount -o remount,ro " + disk + "; " + sweep + "2>" +
                      files.file("read") + "; echo $? >" + files.file("status") + "; " + sweep +
                      "--status >" + files.file("told") + "; mount -o remount,rw " + disk + " && " +
                      sweep + ">/dev/null && cp -r " + disk + "/r " + files.file("after") + "; }"),
      0);
  EXPECT_EQ(contentsOf(files.file("status")), "1\n");
  EXPECT_NE(contentsOf(files.file("read")).find("cannot be written: Read-only file system"),
            std::string::npos)
      << contentsOf(files.file("read"));
  EXPECT_EQ(contentsOf(files.file("told")).rfind("100 of 300 points", 0), 0U);
  EXPECT_EQ(files.results("after"), files.results("whole"));
}

TEST(Sweep, AFolderThatGoesIsNoticedAndGoesOnElsewhere) {
  const Files files(
      "study: {scene: scene.yaml, block: 1}\n" +
      std::string(kStudy).replace(kStudy.find("300"), 3, "500").substr(kStudy.find("\nvary")));
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
  const Files files;
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
  const Files files;
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

}  // namespace
}  // namespace whirl_twin

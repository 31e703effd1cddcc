// A study among the processes of mpirun.
#include <gtest/gtest.h>

#include <chrono>
#include <csignal>
#include <random>
#include <thread>

#include "swept_study.h"

namespace whirl_twin {
namespace sweep_ranks_test {

/// Starts `mpirun -n 4 twin ...` as the leader of a new process group.
pid_t startRanks(const std::vector<std::string>& arguments, const std::string& out,
                 const std::string& err) {
  std::vector<std::string> words{
      "mpirun", "-n", "4", "--oversubscribe", "--allow-run-as-root", WHIRL_TWIN_PROGRAM};
  words.insert(words.end(), arguments.begin(), arguments.end());
  std::vector<char*> argv;
  for (std::string& word : words) {
    argv.push_back(word.data());
  }
  argv.push_back(nullptr);
  const pid_t child = ::fork();
  if (child == 0) {
    ::setpgid(0, 0);
    ::dup2(::open(out.c_str(), O_WRONLY | O_CREAT | O_TRUNC, 0600), STDOUT_FILENO);
    ::dup2(::open(err.c_str(), O_WRONLY | O_CREAT | O_TRUNC, 0600), STDERR_FILENO);
    ::alarm(kHangs);
    ::execv(WHIRL_TWIN_MPIRUN, argv.data());
    ::_exit(127);
  }
  return child;
}

struct Ranks : StudyFiles {
  Ending run(const std::vector<std::string>& arguments) const {
    const int status = statusOf(startRanks(arguments, file("out"), file("err")));
    return {status, contentsOf(file("out")), contentsOf(file("err"))};
  }
};

/// The child processes of a process, with their names.
std::vector<pid_t> childrenOf(pid_t parent) {
  std::vector<pid_t> children;
  std::istringstream list(contentsOf("/proc/" + std::to_string(parent) + "/task/" +
                                     std::to_string(parent) + "/children"));
  for (pid_t child = 0; list >> child;) {
    children.push_back(child);
  }
  return children;
}

TEST(SweepRanks, AreOneRunToTheByte) {
  const Ranks files;
  const Ending alone = files.sweep("alone", {"--workers", "1"});
  ASSERT_EQ(alone.status, 0) << alone.err;
  const Ending four = files.run(files.command("four"));
  EXPECT_EQ(four.status, 0) << four.err;
  EXPECT_EQ(four.out, alone.out);
  EXPECT_EQ(files.results("four"), files.results("alone"));
  EXPECT_EQ(files.blocks("four").size(), 30U);
  const Ending threads = files.run(files.command("threads", {"--workers", "3"}));
  EXPECT_EQ(threads.status, 0) << threads.err;
  EXPECT_EQ(files.results("threads"), files.results("alone"));
  const Ending again = files.run(files.command("threads"));  // nothing remains to be done
  EXPECT_EQ(again.status, 0) << again.err;
  EXPECT_EQ(again.out, alone.out);
}

TEST(SweepRanks, WhatCannotBeMeantIsSaidOnce) {
  const Ranks files;
  files.write("study.yaml", "study: {scene: none.yaml}\n");
  const Ending ending = files.run(files.command("r"));
  EXPECT_EQ(ending.status, 2) << ending.err;
  const Lines lines = linesOf(ending.err);
  EXPECT_EQ(std::count_if(lines.begin(), lines.end(),
                          [](const std::string& line) {
                            return line.find("design: missing") != std::string::npos;
                          }),
            1)
      << ending.err;
  EXPECT_FALSE(std::filesystem::exists(files.file("r")));
}

// A rank that is killed ends the job; when repeated, the command resumes. 3 times; 100 times with
// WHIRL_TWIN_EXTREMES=full.
TEST(SweepRanks, ARankThatIsKilledCostsNoRow) {
  const Ranks files;
  ASSERT_EQ(files.sweep("whole").status, 0);
  std::mt19937 random(1);
  int killed = 0;
  const char* const length = std::getenv("WHIRL_TWIN_EXTREMES");
  const int rounds = length != nullptr && std::string(length) == "full" ? 100 : 3;
  for (int k = 0; k < rounds; ++k) {
    const std::string folder = "killed" + std::to_string(k);
    const pid_t job = startRanks(files.command(folder), files.file("out"), files.file("err"));
    while (!std::filesystem::exists(files.file(folder) + "/manifest.yaml")) {
      std::this_thread::sleep_for(std::chrono::milliseconds(1));
    }
    std::this_thread::sleep_for(std::chrono::milliseconds(random() % 200));
    const std::vector<pid_t> ranks = childrenOf(job);
    if (!ranks.empty()) {
      ::kill(ranks[random() % ranks.size()], SIGKILL);
    }
    killed += statusOf(job) != 0 ? 1 : 0;
    const Ending last = files.run(files.command(folder));
    EXPECT_EQ(last.status, 0) << last.err;
    EXPECT_EQ(files.results(folder), files.results("whole"));
    EXPECT_EQ(files.blocks(folder), files.blocks("whole"));
  }
  EXPECT_GT(killed, 0);
}

TEST(SweepRanks, CtrlCEndsAllOfThemAndTheCommandGoesOn) {
  const Ranks files;
  ASSERT_EQ(files.sweep("whole").status, 0);
  const pid_t job = startRanks(files.command("r"), files.file("out"), files.file("err"));
  while (!std::filesystem::exists(files.file("r") + "/blocks/000000002.csv")) {
    std::this_thread::sleep_for(std::chrono::milliseconds(1));
  }
  ::kill(job, SIGINT);
  EXPECT_NE(statusOf(job), 0);
  EXPECT_EQ(files.run(files.command("r")).status, 0);
  EXPECT_EQ(files.results("r"), files.results("whole"));
}

}  // namespace sweep_ranks_test
}  // namespace whirl_twin

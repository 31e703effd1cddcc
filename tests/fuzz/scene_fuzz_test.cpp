// Any content of a scene file is either run or rejected: no crash, no hang, exit status 0 or 2. A
// thousand corrupted copies of the shipped scenes go through the checks of `twin check`, some of
// them through the program itself.
#include <gtest/gtest.h>
#include <unistd.h>

#include <algorithm>
#include <cmath>
#include <csignal>
#include <cstring>
#include <filesystem>

#include "../tools/twin_program.h"
#include "scene/scene_reader.h"
#include "scene_mutations.h"
#include "twin/observer.h"

namespace whirl_twin {
namespace scene_fuzz_test {

constexpr int kCases = 1000;
constexpr int kEachProgram = 12;   // every 12th case goes through the program too
constexpr unsigned kLongest = 60;  // s, for one case: a hundred times what the slowest takes
constexpr int kSteps = 3;

// A crash or a hang ends the test; this identifies the case, so that it can be reproduced.
char present_case[64] = "before the first case\n";

void sayCase(int signal) {
  const auto written = ::write(STDERR_FILENO, present_case, std::strlen(present_case));
  static_cast<void>(written);
  std::signal(signal, SIG_DFL);
  std::raise(signal);
}

/// The shipped scenes, by name.
std::vector<std::string> shippedScenes() {
  std::vector<std::filesystem::path> paths;
  for (const auto& entry :
       std::filesystem::directory_iterator(WHIRL_TWIN_SOURCE "/config/scenes")) {
    if (entry.path().extension() == ".yaml") {
      paths.push_back(entry.path());
    }
  }
  std::sort(paths.begin(), paths.end());
  std::vector<std::string> texts;
  for (const auto& path : paths) {
    texts.push_back(contentsOf(path));
  }
  return texts;
}

/// Reads the scene and takes a few steps of it; returns its errors.
Lines errorsOf(const std::string& path) {
  try {
    const Scene scene = readSceneFile(path);
    Twin twin(scene);
    twin.buildEnsembles();
    Observer observer(twin);
    std::vector<double> record(twin.layout().size);
    for (int i = 0; i < kSteps; ++i) {
      twin.step();
      twin.write(record.data());
      observer.observe(record.data());
    }
    return {};
  } catch (const SceneError& error) {
    EXPECT_FALSE(error.errors().empty());
    return error.errors();
  }
}

void expectClear(const Lines& errors, const std::string& path) {
  for (const std::string& error : errors) {
    EXPECT_EQ(error.find(path + ": "), 0u) << error;
    EXPECT_GT(error.size(), path.size() + 5) << error;
    EXPECT_TRUE(std::none_of(error.begin(), error.end(), [](unsigned char c) { return c < 0x20; }))
        << "control characters reach the terminal: " << error;
  }
}

/// The program's result for the scene is the library's; a valid scene can be analysed, or the
/// analysis reports why not.
void expectSameFromProgram(const std::string& path, const Lines& errors) {
  const Ending check = twin({"check", path});
  EXPECT_EQ(check.status, errors.empty() ? 0 : 2);
  EXPECT_EQ(linesOf(check.err), errors);
  if (errors.empty()) {
    const Ending analysis = twin({"analyze", path, "--json"});
    EXPECT_TRUE(analysis.status == 0 || analysis.status == 1) << analysis.status;
  }
}

TEST(SceneFuzz, DamagedScenesAreRunOrRefused) {
  for (const int signal : {SIGSEGV, SIGBUS, SIGFPE, SIGILL, SIGABRT, SIGALRM}) {
    std::signal(signal, sayCase);
  }
  const std::vector<std::string> scenes = shippedScenes();
  ASSERT_FALSE(scenes.empty());
  const TemporaryDirectory directory;
  int refused = 0;
  for (int i = 0; i < kCases; ++i) {
    std::snprintf(present_case, sizeof present_case, "\nin case %d of the scene fuzz\n", i);
    SCOPED_TRACE(present_case);
    std::mt19937_64 random(static_cast<std::uint64_t>(i));
    const std::string path = directory.write(
        "case.yaml", mutated(scenes[static_cast<std::size_t>(i) % scenes.size()], random));
    ::alarm(kLongest);
    const Lines errors = errorsOf(path);
    ::alarm(0);
    refused += errors.empty() ? 0 : 1;
    expectClear(errors, path);
    if (i % kEachProgram == 0) {
      expectSameFromProgram(path, errors);
    }
  }
  // Corruption that is always or never detected would test only half of the code.
  EXPECT_GT(refused, kCases / 4);
  EXPECT_LT(refused, kCases * 95 / 100);
  RecordProperty("refused", refused);
}

TEST(SceneFuzz, UndamagedScenesAreSound) {
  const TemporaryDirectory directory;
  for (const std::string& scene : shippedScenes()) {
    EXPECT_EQ(errorsOf(directory.write("scene.yaml", scene)), Lines{});
  }
}

}  // namespace scene_fuzz_test
}  // namespace whirl_twin

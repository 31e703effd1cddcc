// Cost of a study: run-ups of a Jeffcott rotor of 20 s at 1 kHz, with the peak as the measure, by
// one worker and by as many as there are processors; and the share of writing the blocks.
#include <fmt/format.h>
#include <sys/resource.h>
#include <unistd.h>

#include <chrono>
#include <filesystem>
#include <fstream>
#include <iostream>
#include <string>
#include <thread>
#include <vector>

#include "studies/study_reader.h"
#include "studies/sweep.h"

namespace whirl_twin {
namespace {

constexpr double kMillion = 1.0e6;

double cpuSeconds() {
  rusage used{};
  ::getrusage(RUSAGE_SELF, &used);
  const auto seconds = [](const timeval& t) {
    return static_cast<double>(t.tv_sec) + 1.0e-6 * static_cast<double>(t.tv_usec);
  };
  return seconds(used.ru_utime) + seconds(used.ru_stime);
}

double wallSeconds() {
  return std::chrono::duration<double>(std::chrono::steady_clock::now().time_since_epoch()).count();
}

Study studyOf(const std::filesystem::path& folder, int points) {
  std::ofstream(folder / "scene.yaml")
      << "{step: 0.001, drives: {shaft: {speed: 0, profile: [{speed: 200, max_acceleration: "
         "10}]}}, "
         "systems: {rotor: {model: jeffcott_rotor, drive: shaft, integrator: exponential, "
         "parameters: {mass: 1, stiffness: 1.0e4, damping: 10, eccentricity: 1.0e-4}}}}\n";
  std::ofstream(folder / "study.yaml") << fmt::format(
      "study: {{scene: scene.yaml, block: 1000}}\n"
      "vary: {{rotor.stiffness: {{relative_half_width: 0.1}}, "
      "rotor.eccentricity: {{normal: [1.0e-4, 1.0e-5]}}}}\n"
      "design: {{latin_hypercube: {}}}\nrun: {{duration: 20}}\n"
      "measure: {{peak: max(rotor.whirl.radius)}}\n",
      points);
  return readStudy(folder / "study.yaml");
}

struct Cost {
  double cpu, wall;  // s
};

Cost costOf(const std::filesystem::path& folder, const Study& study, unsigned workers) {
  const ResultFolder results((folder / std::to_string(workers)).string(), study, false);
  BlockDeck deck(unfinishedBlocks(study, results, {}));
  std::atomic<bool> stop{false};
  const double cpu = cpuSeconds();
  const double wall = wallSeconds();
  sweep(
      study, results, workers, [&](std::uint64_t) { return deck.next(); }, stop,
      [](std::uint64_t) {});
  return {cpuSeconds() - cpu, wallSeconds() - wall};
}

/// To write the first rows of a block.
Cost writingCost(const std::filesystem::path& folder, const Study& study, std::size_t rows) {
  constexpr int kTimes = 50;
  const ResultFolder results((folder / "writing").string(), study, false);
  const std::vector<Outcome> outcomes(rows, Outcome{{1.0 / 3.0}, ""});
  const double cpu = cpuSeconds();
  const double wall = wallSeconds();
  for (int i = 0; i < kTimes; ++i) {
    results.write(0, outcomes);
  }
  return {(cpuSeconds() - cpu) / kTimes, (wallSeconds() - wall) / kTimes};
}

void compare(bool quick) {
  std::string name = (std::filesystem::temp_directory_path() / "study_XXXXXX").string();
  const std::filesystem::path folder = ::mkdtemp(name.data());
  const int blocks = quick ? 2 : 100;
  const Study study = studyOf(folder, 1000 * blocks);
  const double scale = kMillion / static_cast<double>(study.points());
  fmt::print(
      "| workers | CPU time of a million, s | elapsed, s | parallel efficiency |\n"
      "|---|---|---|---|\n");
  const unsigned most = std::max(2U, std::thread::hardware_concurrency());
  double alone = 0.0;
  double block = 0.0;
  for (unsigned workers = 1; workers <= most; workers *= 2) {
    const Cost cost = costOf(folder, study, workers);
    alone = workers == 1 ? cost.wall : alone;
    block = workers == 1 ? cost.cpu / blocks : block;
    fmt::print("| {} | {:.1f} | {:.1f} | {:.2f} |\n", workers, scale * cost.cpu, scale * cost.wall,
               alone / cost.wall / workers);
  }
  const Cost rows = writingCost(folder, study, 1000);
  const Cost file = writingCost(folder, study, 1);
  rusage used{};
  ::getrusage(RUSAGE_SELF, &used);
  fmt::print(
      "\nA block of 1000 takes {:.1f} ms of CPU time, of which formatting its rows takes {:.2f} ms "
      "and writing "
      "its file, which is complete on the disk before it gets its name, {:.2f} ms ({:.1f} ms "
      "elapsed). Memory: "
      "{} MB at most.\n",
      1.0e3 * block, 1.0e3 * (rows.cpu - file.cpu), 1.0e3 * file.cpu, 1.0e3 * file.wall,
      used.ru_maxrss / 1024);
  std::filesystem::remove_all(folder);
}

}  // namespace
}  // namespace whirl_twin

int main(int argc, char** argv) {
  const bool quick = argc == 2 && std::string(argv[1]) == "--quick";
  if (argc != 1 && !quick) {
    std::cerr << "usage: study_benchmark [--quick]\n";
    return 2;
  }
  whirl_twin::compare(quick);
  return 0;
}

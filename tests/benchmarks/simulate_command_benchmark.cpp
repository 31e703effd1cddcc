// Cost of a step in `twin simulate` with few samples, compared with the step alone: CPU time of a
// long run minus that of a short one, which excludes start, calibration and printing.
#include <fcntl.h>
#include <fmt/format.h>
#include <spawn.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <iostream>
#include <memory>
#include <stdexcept>
#include <string>
#include <vector>

#include "realtime/denormals.h"
#include "scene/scene_reader.h"
#include "step_costs.h"
#include "twin/twin.h"

namespace whirl_twin {
namespace {

struct Case {
  std::string name;
  std::string scene;
};

const std::vector<Case> kCases{
    {"Jeffcott rotor, constant speed",
     "{gravity: 9.81, step: 0.001, systems: {rotor: {model: jeffcott_rotor, parameters: "
     "{mass: 2, stiffness: 2.0e4, damping: 10, eccentricity: 1.0e-4, speed: 80}}}}"},
    {"the same with internal damping",
     "{gravity: 9.81, step: 0.001, systems: {rotor: {model: jeffcott_rotor, parameters: "
     "{mass: 2, stiffness: 2.0e4, damping: 10, internal_damping: 2, eccentricity: 1.0e-4, "
     "speed: 80}}}}"},
    {"the same without, in a run-up",
     "{step: 0.001, drives: {shaft: {speed: 0, profile: [{speed: 200, max_acceleration: 0.01}]}}, "
     "systems: {rotor: {model: jeffcott_rotor, drive: shaft, parameters: {mass: 2, stiffness: "
     "2.0e4, damping: 10, eccentricity: 1.0e-4}}}}"},
    {"shaft of 8 modes, constant speed",
     "{step: 0.001, systems: {rotor: {model: flexible_rotor, parameters: {youngs_modulus: 2.1e+11, "
     "density: 7800, speed: 300, elements: [{length: 0.2, outer_diameter: 0.03, count: 6}], "
     "discs: [{node: 2, mass: 5, polar_inertia: 0.02, transverse_inertia: 0.012}], "
     "bearings: [{node: 0, kxx: 1.0e+6, kyy: 2.0e+6, cxx: 200, cyy: 200}, "
     "{node: 6, kxx: 1.0e+6, kyy: 2.0e+6, cxx: 200, cyy: 200}], "
     "unbalances: [{node: 2, magnitude: 1.0e-4, angle: 0.3}], modes: 8, highest_speed: 400}}}}"},
    {"double pendulum, stoermer_6",
     "{gravity: 9.81, step: 0.001, systems: {pendulum: {model: double_pendulum, parameters: "
     "{mass1: 1, mass2: 1, length1: 1, length2: 1}, initial: {theta1: 0.2, theta2: 0.3}, "
     "integrator: stoermer_6}}}"},
    {"double pendulum, stoermer_ahead, 16 steps at once",
     "{gravity: 9.81, step: 0.001, systems: {pendulum: {model: double_pendulum, parameters: "
     "{mass1: 1, mass2: 1, length1: 1, length2: 1}, initial: {theta1: 0.2, theta2: 0.3}, "
     "integrator: stoermer_ahead, substeps: 16}}}"},
    {"double pendulum, dormand_prince_8",
     "{gravity: 9.81, step: 0.001, systems: {pendulum: {model: double_pendulum, parameters: "
     "{mass1: 1, mass2: 1, length1: 1, length2: 1}, initial: {theta1: 0.2, theta2: 0.3}, "
     "integrator: dormand_prince_8}}}"}};

/// User and system time [s] of a command that must succeed; its output is discarded.
double cpuTime(const std::vector<std::string>& command) {
  std::vector<char*> words;
  for (const std::string& word : command) {
    words.push_back(const_cast<char*>(word.c_str()));
  }
  words.push_back(nullptr);
  posix_spawn_file_actions_t actions;
  posix_spawn_file_actions_init(&actions);
  posix_spawn_file_actions_addopen(&actions, STDOUT_FILENO, "/dev/null", O_WRONLY, 0);
  pid_t process = 0;
  const int refused = posix_spawn(&process, words[0], &actions, nullptr, words.data(), ::environ);
  posix_spawn_file_actions_destroy(&actions);
  int status = 0;
  rusage used{};
  if (refused != 0 || wait4(process, &status, 0, &used) != process || status != 0) {
    throw std::runtime_error(command[0] + " simulate failed");
  }
  const auto seconds = [](const timeval& t) {
    return static_cast<double>(t.tv_sec) + 1.0e-6 * static_cast<double>(t.tv_usec);
  };
  return seconds(used.ru_utime) + seconds(used.ru_stime);
}

/// [ns] a step of a millisecond.
double commandCost(const std::string& twin, const std::string& scene, int seconds) {
  const auto run = [&](int duration) {
    return cpuTime({twin, "simulate", scene, "--duration", std::to_string(duration), "--sample",
                    std::to_string(seconds / 4)});
  };
  return (run(3 * seconds) - run(seconds)) / (2.0e3 * seconds) * 1.0e9;
}

double median(std::vector<double> all) {
  std::nth_element(all.begin(), all.begin() + all.size() / 2, all.end());
  return all[all.size() / 2];
}

void compare(const std::string& twin, bool quick) {
  const int rounds = quick ? 1 : 9;
  const int seconds = quick ? 40 : 4000;
  const std::filesystem::path file =
      std::filesystem::temp_directory_path() / fmt::format("twin_simulate_{}.yaml", ::getpid());
  fmt::print(
      "| scene | the step, ns | `twin simulate`, ns per step | ratio |\n|---|---|---|---|\n");
  for (const Case& it : kCases) {
    std::ofstream(file) << it.scene;
    Twin alone(readScene(YAML::Load(it.scene), "benchmark"));
    std::vector<double> steps;
    std::vector<double> commands;
    const auto stepCost = [&] {
      const Stepped step{it.name, [&](int count) { advance(alone, count); }};
      return stepCosts({step}, quick ? Effort{1, 1.0} : Effort{3, 30.0})[0].median;
    };
    double before = stepCost();
    for (int round = 0; round < rounds; ++round) {
      commands.push_back(commandCost(twin, file.string(), seconds));
      const double after = stepCost();
      steps.push_back(0.5 * (before + after));
      before = after;
    }
    fmt::print("| {} | {:.1f} | {:.1f} | {:.2f} |\n", it.name, median(steps), median(commands),
               median(commands) / median(steps));
  }
  std::filesystem::remove(file);
}

}  // namespace
}  // namespace whirl_twin

int main(int argc, char** argv) {
  const bool quick = argc == 3 && std::string(argv[2]) == "--quick";
  if (argc != 2 && !quick) {
    std::cerr << "usage: simulate_command_benchmark TWIN [--quick]\n";
    return 2;
  }
  const whirl_twin::DenormalsToZero denormals_to_zero;
  whirl_twin::compare(argv[1], quick);
  return 0;
}

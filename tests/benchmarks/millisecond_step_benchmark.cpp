// A step of exactly a millisecond of the two pendulums of docs/benchmarks.md, with the energy
// audit, by every explicit method: its mean and maximum cost, and its error over 100 s.
#include <fmt/format.h>
#include <time.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <iostream>
#include <memory>
#include <string>
#include <vector>

#include "accuracy/trajectory.h"
#include "accuracy/trajectory_error.h"
#include "realtime/denormals.h"
#include "scene/scene_reader.h"
#include "step_costs.h"
#include "twin/twin.h"

namespace whirl_twin {
namespace {

constexpr std::int64_t kMillisecond = 1000000;  // ns
constexpr std::size_t kSamples = 418;
constexpr std::int64_t kInterval = 240 * kMillisecond;
constexpr int kRuns = 60;  // for the dearest step
constexpr int kSteps = 3000;
const std::vector<std::string> kMethods{"runge_kutta_4",
                                        "dormand_prince_8",
                                        "stoermer_6",
                                        "stoermer",
                                        "stoermer_ahead, substeps: 8",
                                        "stoermer_ahead, substeps: 24"};

Scene pendulum(const std::string& system, const std::string& integrator) {
  return readScene(YAML::Load("{gravity: 9.81, step: 0.001, systems: {pendulum: {" + system +
                              ", integrator: " + integrator + "}}}"),
                   "benchmark");
}

double nanoseconds() {
  timespec now{};
  clock_gettime(CLOCK_MONOTONIC, &now);
  return 1.0e9 * static_cast<double>(now.tv_sec) + static_cast<double>(now.tv_nsec);
}

/// For each step of a run the minimum over the runs, which excludes other load of the machine; of
/// these the maximum.
double dearest(Twin& twin, int runs) {
  std::vector<double> least(kSteps, 1.0e9);
  for (int run = 0; run < runs; ++run) {
    twin.reset();
    for (double& of_step : least) {
      const double start = nanoseconds();
      twin.step();
      of_step = std::min(of_step, nanoseconds() - start);
    }
  }
  return *std::max_element(least.begin(), least.end());
}

double clockCost() {
  double least = 1.0e9;
  for (int i = 0; i < 1000; ++i) {
    const double start = nanoseconds();
    least = std::min(least, nanoseconds() - start);
  }
  return least;
}

void compare(const std::string& name, const std::string& system, bool quick) {
  const Scene fine =
      withSetting(pendulum(system, "gauss_legendre_6"), {"gauss_legendre_6", kMillisecond, 4});
  const Trajectory reference = motion(fine, kInterval, kSamples);
  std::vector<std::shared_ptr<Twin>> twins;
  std::vector<Stepped> stepped;
  for (const std::string& method : kMethods) {
    twins.push_back(std::make_shared<Twin>(pendulum(system, method)));
    stepped.push_back({method, [twin = twins.back()](int steps) { advance(*twin, steps); }});
  }
  const std::vector<StepCost> costs = stepCosts(stepped, quick ? Effort{3, 1.0} : Effort{25, 20.0});
  fmt::print(
      "\n{}\n\n| integrator | ns per step | quartiles | slowest step | error over 100 s |\n"
      "|---|---|---|---|---|\n",
      name);
  for (std::size_t i = 0; i < kMethods.size(); ++i) {
    const double error =
        ErrorCurve(motion(pendulum(system, kMethods[i]), kInterval, kSamples), reference)
            .position(kSamples - 1);
    fmt::print("| {} | {:.1f} | {:.1f} to {:.1f} | {:.0f} | {:.1e} |\n", kMethods[i],
               costs[i].median, costs[i].lower_quartile, costs[i].upper_quartile,
               dearest(*twins[i], quick ? 2 : kRuns) - clockCost(), error);
  }
}

}  // namespace
}  // namespace whirl_twin

int main(int argc, char** argv) {
  const bool quick = argc == 2 && std::string(argv[1]) == "--quick";
  if (argc > 1 && !quick) {
    std::cerr << "usage: millisecond_step_benchmark [--quick]\n";
    return 2;
  }
  const whirl_twin::DenormalsToZero denormals_to_zero;
  whirl_twin::compare("Double pendulum, released at (0.2, 0.3) rad",
                      "model: double_pendulum, parameters: {mass1: 1, mass2: 1, length1: 1, "
                      "length2: 1}, initial: {theta1: 0.2, theta2: 0.3}",
                      quick);
  whirl_twin::compare("Spinning pendulum at 1.5 times the speed of its bifurcation, from 0.2 rad",
                      "model: spinning_pendulum, parameters: {mass: 1, length: 1, speed: "
                      "4.698138993202}, initial: {theta: 0.2}",
                      quick);
  return 0;
}

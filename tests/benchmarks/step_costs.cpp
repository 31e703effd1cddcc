#include "step_costs.h"

#include <time.h>

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <stdexcept>

#include "twin/stop_text.h"

namespace whirl_twin {
namespace {

constexpr std::int64_t kRestart = 14000;

double cpuNanoseconds() {
  timespec now{};
  clock_gettime(CLOCK_THREAD_CPUTIME_ID, &now);
  return 1.0e9 * static_cast<double>(now.tv_sec) + static_cast<double>(now.tv_nsec);
}

double timed(const Stepped& one, int steps) {
  const double start = cpuNanoseconds();
  one.advance(steps);
  return cpuNanoseconds() - start;
}

/// Number of steps in a round. Of two trials the shorter: the first steps include preparation.
int stepsOfTurn(const Stepped& one, double turn_ms) {
  int steps = 1;
  while (std::min(timed(one, steps), timed(one, steps)) < 1.0e6 * turn_ms) {
    steps *= 2;
  }
  return steps;
}

double quantile(const std::vector<double>& sorted, double share) {
  return sorted[static_cast<std::size_t>(share * static_cast<double>(sorted.size() - 1) + 0.5)];
}

}  // namespace

std::vector<StepCost> stepCosts(const std::vector<Stepped>& all, const Effort& effort) {
  std::vector<int> steps;
  for (const Stepped& one : all) {
    steps.push_back(stepsOfTurn(one, effort.turn_ms));
  }
  std::vector<std::vector<double>> costs(all.size());
  for (int round = 0; round < effort.rounds; ++round) {
    for (std::size_t turn = 0; turn < all.size(); ++turn) {
      const std::size_t i = (turn + static_cast<std::size_t>(round)) % all.size();
      all[i].advance(1 + steps[i] / 10);  // not counted: warms the caches
      costs[i].push_back(timed(all[i], steps[i]) / steps[i]);
    }
  }
  std::vector<StepCost> found;
  for (std::vector<double>& of_one : costs) {
    std::sort(of_one.begin(), of_one.end());
    found.push_back({quantile(of_one, 0.5), quantile(of_one, 0.25), quantile(of_one, 0.75)});
  }
  return found;
}

void advance(Twin& twin, int steps) {
  for (int i = 0; i < steps; ++i) {
    twin.step();
    if (twin.stepCount() == kRestart) {
      twin.reset();
    }
  }
  for (std::size_t i = 0; i < twin.systems().size(); ++i) {
    if (twin.status(i) != StepStatus::kOk) {
      throw std::runtime_error(twin.systems()[i]->spec.name + ": " + describe(twin.status(i)));
    }
  }
}

}  // namespace whirl_twin

#include "reports/step_cost.h"

#include <fmt/format.h>
#include <malloc.h>

#include <algorithm>
#include <chrono>
#include <cstdint>
#include <limits>
#include <vector>

#include "realtime/denormals.h"
#include "twin/twin.h"

namespace whirl_twin {

namespace {

constexpr int kCostRounds = 7;
constexpr std::int64_t kMostTimedSteps = 1 << 20;

/// [s] for so many steps from the start, or NaN.
double secondsOfSteps(Twin& twin, std::int64_t steps) {
  twin.reset();
  const auto start = std::chrono::steady_clock::now();
  for (std::int64_t i = 0; i < steps; ++i) {
    twin.step();
  }
  const std::chrono::duration<double> taken = std::chrono::steady_clock::now() - start;
  for (std::size_t i = 0; i < twin.systems().size(); ++i) {
    if (twin.status(i) != StepStatus::kOk) {
      return std::numeric_limits<double>::quiet_NaN();
    }
  }
  return taken.count();
}

}  // namespace

std::size_t heapInUse() {
  const auto info = ::mallinfo2();
  return info.uordblks + info.hblkhd;
}

RunningCost runningCost(const Scene& scene, double budget) {
  const DenormalsToZero denormals_to_zero;
  RunningCost cost;
  const std::size_t before = heapInUse();
  Twin twin(scene);
  twin.buildEnsembles();
  cost.memory = heapInUse() - before;
  for (std::size_t i = 0; i < twin.systems().size(); ++i) {
    const Ensemble* const ensemble = twin.ensemble(i);
    cost.ensembles.push_back(ensemble == nullptr ? ""
                                                 : fmt::format("{} samples, {}", ensemble->count(),
                                                               ensemble->steps().description()));
  }
  // Double the steps until a round is long enough to be timed, which warms up as well.
  const double round = budget / (2 * kCostRounds);
  std::int64_t steps = 1;
  double taken = secondsOfSteps(twin, steps);
  while (taken < round && steps < kMostTimedSteps) {
    steps *= 2;
    taken = secondsOfSteps(twin, steps);
  }
  std::vector<double> rounds{taken};
  for (int i = 1; i < kCostRounds && taken < budget; ++i) {
    rounds.push_back(secondsOfSteps(twin, steps));
  }
  const auto middle = rounds.begin() + static_cast<std::ptrdiff_t>(rounds.size() / 2);
  std::nth_element(rounds.begin(), middle, rounds.end());
  cost.step = 1.0e9 * *middle / static_cast<double>(steps);
  return cost;
}

}  // namespace whirl_twin

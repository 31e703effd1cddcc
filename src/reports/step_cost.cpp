#include "reports/step_cost.h"

#include <fmt/format.h>
#include <malloc.h>

#include <algorithm>
#include <chrono>
#include <cstdint>
#include <memory>
#include <utility>
#include <vector>

#include "algebra/constants.h"
#include "realtime/denormals.h"
#include "twin/twin.h"

namespace whirl_twin {

namespace {

constexpr int kCostRounds = 7;
constexpr std::int64_t kMaxTimedSteps = 1 << 20;

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
      return kNaN;
    }
  }
  return taken.count();
}

constexpr std::size_t kTimingRounds = 7;
constexpr double kMinRound = 1.0e-3;  // s, of a round
constexpr double kMaxRound = 2.0e-2;

struct TimedScene {
  std::unique_ptr<Twin> twin;
  std::int64_t steps = 0;           // of one run
  int runs = 1;                     // in one round
  std::vector<double> rounds = {};  // [ns] of a step
};

/// [s] for a round.
double secondsOfRound(TimedScene& c) {
  const auto start = std::chrono::steady_clock::now();
  for (int run = 0; run < c.runs; ++run) {
    c.twin->reset();
    for (std::int64_t i = 0; i < c.steps; ++i) {
      c.twin->step();
    }
  }
  return std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
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
  while (taken < round && steps < kMaxTimedSteps) {
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

std::vector<StepTiming> interleavedTimings(const std::vector<Scene>& scenes, std::int64_t duration,
                                           const std::function<void(double)>& progress) {
  const DenormalsToZero denormals_to_zero;
  std::vector<TimedScene> candidates;
  for (const Scene& scene : scenes) {
    TimedScene c{std::make_unique<Twin>(scene), std::max<std::int64_t>(1, duration / scene.step)};
    for (double taken = secondsOfRound(c); taken < kMinRound; taken = secondsOfRound(c)) {
      c.runs *= 2;
    }
    for (double taken = secondsOfRound(c); taken > kMaxRound && c.steps > 16;
         taken = secondsOfRound(c)) {
      c.steps /= 2;
    }
    candidates.push_back(std::move(c));
  }
  for (std::size_t round = 0; round < kTimingRounds; ++round) {
    for (std::size_t k = 0; k < candidates.size(); ++k) {
      TimedScene& c =
          candidates[(k + round * candidates.size() / kTimingRounds) % candidates.size()];
      const double steps = static_cast<double>(c.steps) * c.runs;
      c.rounds.push_back(1.0e9 * secondsOfRound(c) / steps);
    }
    progress(static_cast<double>(round + 1) / kTimingRounds);
  }
  std::vector<StepTiming> timings;
  for (TimedScene& c : candidates) {
    std::sort(c.rounds.begin(), c.rounds.end());
    timings.push_back({c.rounds[kTimingRounds / 2], c.rounds.back() - c.rounds.front()});
  }
  return timings;
}

}  // namespace whirl_twin

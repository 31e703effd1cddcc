#include "reports/step_timing.h"

#include <algorithm>
#include <chrono>
#include <cstdint>
#include <memory>
#include <utility>

#include "realtime/denormals.h"
#include "twin/twin.h"

namespace whirl_twin {

namespace {

constexpr std::size_t kTimingRounds = 7;
constexpr double kShortestRound = 1.0e-3;  // s, of a round
constexpr double kLongestRound = 2.0e-2;

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

std::vector<StepTiming> interleavedTimings(const std::vector<Scene>& scenes, std::int64_t duration,
                                           const std::function<void(double)>& progress) {
  const DenormalsToZero denormals_to_zero;
  std::vector<TimedScene> candidates;
  for (const Scene& scene : scenes) {
    TimedScene c{std::make_unique<Twin>(scene), std::max<std::int64_t>(1, duration / scene.step)};
    for (double taken = secondsOfRound(c); taken < kShortestRound; taken = secondsOfRound(c)) {
      c.runs *= 2;
    }
    for (double taken = secondsOfRound(c); taken > kLongestRound && c.steps > 16;
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

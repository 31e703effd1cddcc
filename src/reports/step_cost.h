// What a step costs on this machine, measured.
#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <string>
#include <vector>

#include "scene/scene.h"

namespace whirl_twin {

struct RunningCost {
  /// Wall time of one step [ns] of all systems and ensembles on their drives: the median of several
  /// short rounds from the start. NaN if a system stops in them.
  double step = 0.0;
  std::size_t memory = 0;  ///< [bytes], heap of the twin
  /// Of each system: "1000 members, side by side in vectors"; "" where there is no ensemble.
  std::vector<std::string> ensembles;
};

/// Of a scene, measured for about `budget` [s] once it is built.
RunningCost runningCost(const Scene& scene, double budget);

/// [bytes] of the heap in use; large blocks are mapped each by itself.
std::size_t heapInUse();

struct StepTiming {
  double median = 0.0;  ///< [ns] of a step, over the rounds
  double spread = 0.0;  ///< [ns], slowest round less fastest
};

/// One for each scene, over the duration [ns] from its start, or the beginning of that if it takes
/// long. progress gets the fraction done, 0 to 1.
std::vector<StepTiming> interleavedTimings(const std::vector<Scene>& scenes, std::int64_t duration,
                                           const std::function<void(double)>& progress);

}  // namespace whirl_twin

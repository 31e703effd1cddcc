// Step costs of several scenes that can be compared: measured in turn, so that all of them see the
// same machine, drifting as it may.
#pragma once

#include <cstdint>
#include <functional>
#include <vector>

#include "scene/scene.h"

namespace whirl_twin {

struct StepTiming {
  double median = 0.0;  ///< [ns] of a step, over the rounds
  double spread = 0.0;  ///< [ns], slowest round less fastest
};

/// One for each scene, over the duration [ns] from its start, or the beginning of that if it takes
/// long. progress is told the share done, 0 to 1.
std::vector<StepTiming> interleavedTimings(const std::vector<Scene>& scenes, std::int64_t duration,
                                           const std::function<void(double)>& progress);

}  // namespace whirl_twin

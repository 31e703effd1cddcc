// What a step costs on this machine, measured.
#pragma once

#include <cstddef>

#include "scene/scene.h"

namespace whirl_twin {

/// Wall time of one step [ns] of these systems of the scene on their drives: the median of several
/// short rounds from the start, together about `budget` [s]. NaN if a system stops in them.
double stepCost(const Scene& scene, double budget);

/// Heap that the running twin of a scene takes [bytes].
std::size_t twinMemory(const Scene& scene);

}  // namespace whirl_twin

// What a loop does when nothing moves: its equations at rest, exact whatever the rates are.
#pragma once

#include <vector>

#include "analysis/sampled_loop.h"

namespace whirl_twin {

/// In how many directions plant and laws rest wherever they are left, to 1e-13 of the terms that
/// cancel there (a magnet that takes away just the stiffness that its bias gives). Rest does not
/// depend on rates, delays and poles of sensors and actuators.
int standingDirections(const LoopPlant& plant, const std::vector<LoopController>& controllers);

}  // namespace whirl_twin

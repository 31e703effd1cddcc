// How long the moves of a drive last.
#pragma once

#include <vector>

#include "scene/scene.h"

namespace whirl_twin {

/// Duration [s] of the change of speed of each move of a drive's profile, without the dwell.
std::vector<double> changeDurations(const DriveSpec& drive);

/// Duration [s] of the whole profile, dwells included; 0 for a drive without one.
double profileDuration(const DriveSpec& drive);

}  // namespace whirl_twin

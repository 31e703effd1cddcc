// Which part of the twin to look at when its steps take too long.
#pragma once

#include <string>

#include "messages/loop_statistics.h"

namespace whirl_twin {

/// The part that most long steps were due to, or that takes most of a step where there were none:
/// "rotor: 3.1 us of a step, at most 1204.7 us; took most of 12 long steps". "" where nothing was
/// timed.
std::string slowestPart(const state::LoopStatistics& loop);

}  // namespace whirl_twin

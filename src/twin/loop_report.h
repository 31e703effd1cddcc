// Loop statistics: timing of the loop as a message.
#pragma once

#include "messages/loop_statistics.h"
#include "realtime/fixed_rate_loop.h"
#include "twin/live_twin.h"
#include "twin/observer.h"

namespace whirl_twin {

/// All fields except the stamp.
state::LoopStatistics loopStatistics(const Twin& twin, const Observer& observer,
                                     const RealtimeStatus& status, const LoopTiming& timing,
                                     bool paused, std::uint64_t dropped);

/// Adds the computing times of the systems and of the controllers in a step.
void addStepTimes(const LiveTwin& live, state::LoopStatistics& loop);

}  // namespace whirl_twin

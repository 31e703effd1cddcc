// How the loop keeps its time, as a message and as a diagnostics summary.
#pragma once

#include <diagnostic_updater/diagnostic_updater.h>

#include "messages/loop_statistics.h"
#include "realtime/fixed_rate_loop.h"
#include "twin/observer.h"

namespace whirl_twin {

/// Everything but the stamp.
state::LoopStatistics loopStatistics(const Twin& twin, const Observer& observer,
                                     const RealtimeStatus& status, const LoopTiming& timing,
                                     bool paused, std::uint64_t dropped);

/// OK, or a warning when periods were skipped or records dropped, or an error when a system
/// stopped.
void summarize(const state::LoopStatistics& loop,
               diagnostic_updater::DiagnosticStatusWrapper& status);

}  // namespace whirl_twin

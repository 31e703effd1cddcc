// How the loop keeps its time, as a message and as a diagnostics summary.
#pragma once

#include <diagnostic_updater/diagnostic_updater.h>

#include "messages/loop_statistics.h"
#include "nodes/rising_count.h"
#include "realtime/fixed_rate_loop.h"
#include "twin/live_twin.h"
#include "twin/observer.h"

namespace whirl_twin {

/// Everything but the stamp.
state::LoopStatistics loopStatistics(const Twin& twin, const Observer& observer,
                                     const RealtimeStatus& status, const LoopTiming& timing,
                                     bool paused, std::uint64_t dropped);

/// What the parts of the twin take of its steps.
void addStepTimes(const LiveTwin& live, state::LoopStatistics& loop);

class LoopDiagnostics {
 public:
  /// OK, or a warning when within the last ten seconds periods were skipped, or states not
  /// published or not sent, or an error when a system has stopped. time [s]: of a clock that
  /// nobody sets.
  void summarize(const state::LoopStatistics& loop, double time,
                 diagnostic_updater::DiagnosticStatusWrapper& status);

 private:
  RisingCount dropped_, skipped_, lcm_failed_, ros_lost_;
};

}  // namespace whirl_twin

// Loop statistics: timing of the loop as a message and as a diagnostics summary.
#pragma once

#include <diagnostic_updater/diagnostic_updater.h>

#include "messages/loop_statistics.h"
#include "nodes/rising_count.h"
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

class LoopDiagnostics {
 public:
  /// OK, or a warning when within the last ten seconds periods were skipped, or states not
  /// published or not sent, or an error when a system has stopped. time [s]: of a monotonic
  /// clock.
  void summarize(const state::LoopStatistics& loop, double time,
                 diagnostic_updater::DiagnosticStatusWrapper& status);

 private:
  RisingCount dropped_, skipped_, lcm_failed_, ros_lost_;
};

}  // namespace whirl_twin

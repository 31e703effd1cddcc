// Diagnostics summary of the loop statistics.
#pragma once

#include <diagnostic_updater/diagnostic_updater.h>

#include "messages/loop_statistics.h"
#include "nodes/rising_count.h"
#include "twin/loop_report.h"

namespace whirl_twin {

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

#include "nodes/loop_report.h"

#include <fmt/format.h>

#include "messages/loop_statistics.h"

namespace whirl_twin {

void LoopDiagnostics::summarize(const state::LoopStatistics& loop, double time,
                                diagnostic_updater::DiagnosticStatusWrapper& status) {
  using diagnostic_msgs::DiagnosticStatus;
  status.summary(DiagnosticStatus::OK, loop.paused ? "paused" : "running");
  if (dropped_.roseLately(loop.dropped_snapshots, time)) {
    status.mergeSummary(DiagnosticStatus::WARN, "states were not published: publisher too slow");
  }
  if (lcm_failed_.roseLately(loop.lcm_failed, time)) {
    status.mergeSummary(DiagnosticStatus::WARN, "messages could not be sent on LCM");
  }
  if (ros_lost_.roseLately(loop.ros_lost, time)) {
    status.mergeSummary(DiagnosticStatus::WARN, "a subscriber is too slow: messages were lost");
  }
  if (skipped_.roseLately(loop.skipped_steps, time)) {
    status.mergeSummary(DiagnosticStatus::WARN, "steps were skipped: the computer was too slow");
  }
  for (std::size_t i = 0; i < loop.system.size(); ++i) {
    if (loop.stopped[i] != 0) {
      status.mergeSummary(DiagnosticStatus::ERROR, loop.stopped_why[i]);
    } else if (loop.error_estimate[i] > loop.tolerance[i]) {
      status.mergeSummaryf(DiagnosticStatus::WARN,
                           "%s: error about %.1e over the horizon, tolerance %g",
                           loop.system[i].c_str(), loop.error_estimate[i], loop.tolerance[i]);
    }
  }
  status.add("step", loop.at.step);
  status.add("simulated time [s]", loop.at.time);
  status.add("scheduling policy", loop.policy);
  status.add("priority", loop.priority);
  status.add("memory locked", loop.memory_locked);
  status.add("processor", loop.cpu);
  status.add("overruns", loop.overruns);
  status.add("overruns by late wake-up", loop.late_wakeups);
  status.add("skipped steps", loop.skipped_steps);
  status.add("dropped states", loop.dropped_snapshots);
  status.add("messages not sent on LCM", loop.lcm_failed);
  status.add("messages lost by slow subscribers", loop.ros_lost);
  status.add("published every [steps]", loop.publish_every);
  status.add("real-time factor", loop.real_time_factor);
  status.add("real-time factor achieved", loop.achieved_factor);
  status.add("wake-up latency p99 [s]", loop.wakeup_latency_p99);
  status.add("wake-up latency max [s]", loop.wakeup_latency_max);
  status.add("execution p99 [s]", loop.execution_p99);
  const std::string slowest = slowestPart(loop);
  if (!slowest.empty()) {
    status.add("slowest in a step", slowest);
  }
  for (std::size_t i = 0; i < loop.external.size(); ++i) {
    status.add(loop.external[i] + ": age of commands p50, p99, max [samples]",
               fmt::format("{}, {}, {}", loop.age_p50[i], loop.age_p99[i], loop.age_max[i]));
  }
}

}  // namespace whirl_twin

// Timing of the fixed-rate loop of a simulation, and the status of its systems. Latencies since the
// last reset, without warm-up.
#pragma once

#include <cstdint>
#include <limits>
#include <string>
#include <vector>

#include "messages/states.h"

namespace whirl_twin::state {

struct LoopStatistics {
  static constexpr double kNotKnown = std::numeric_limits<double>::quiet_NaN();
  static constexpr MessageKind kKind{"loop", "LoopStatistics", "loop", MessageKind::kLatched};

  Instant at;              ///< stamp: wall clock, or simulated time
  double step_size = 0.0;  ///< [s]
  std::string policy;      ///< SCHED_FIFO or SCHED_OTHER, as obtained
  std::int32_t priority = 0;
  bool memory_locked = false;
  std::string kernel;
  bool paused = false;
  std::uint64_t overruns = 0;           ///< cycles that ended after the next one was due
  std::uint64_t skipped_steps = 0;      ///< periods skipped to keep the phase
  std::uint64_t dropped_snapshots = 0;  ///< states not published because the publisher was behind
  std::uint64_t page_faults = 0;        ///< of the loop's thread
  double wakeup_latency_p50 = 0.0;      ///< [s]
  double wakeup_latency_p99 = 0.0;      ///< [s]
  double wakeup_latency_max = 0.0;      ///< [s]
  double execution_p50 = 0.0;           ///< [s], of one step of everything
  double execution_p99 = 0.0;           ///< [s]
  double execution_max = 0.0;           ///< [s]
  double period_min = 0.0;              ///< [s]
  double period_max = 0.0;              ///< [s]
  // One entry a system.
  std::vector<std::string> system;
  std::vector<std::string> integrator;
  std::vector<double> error_estimate;    ///< [-], NaN: not estimated
  std::vector<double> tolerance;         ///< [-], error bound of integrator: auto; else NaN
  std::vector<std::uint8_t> stopped;     ///< 0: running, 1 to 5: as in the message
  std::vector<std::string> stopped_why;  ///< empty while running
  // Identifies the run of simulated time: a reset increments the epoch, a restart of the simulation
  // has a later start; 0: unknown.
  std::int64_t started = 0;         ///< [ns], wall clock when the simulation was started
  std::uint64_t epoch = 0;          ///< resets since then
  std::uint64_t lcm_failed = 0;     ///< messages that LCM could not send
  std::uint64_t publish_every = 0;  ///< steps from one publication to the next, at present
  // Simulated time relative to wall time [-]; NaN: unknown.
  double real_time_factor = kNotKnown;  ///< asked; 0: all it can
  double achieved_factor = kNotKnown;   ///< since the last message
  std::uint64_t ros_lost = 0;           ///< messages lost because ROS subscribers were too slow
  std::string sender;                   ///< readable name of the publishing process; empty: unknown
  // One entry a controller in another process: the age of its newest command at each sample, since
  // the start or the last reset [samples]; NaN: there was none.
  std::vector<std::string> external;
  std::vector<double> age_p50;
  std::vector<double> age_p99;
  std::vector<double> age_max;
  // Added later; NaN: unknown.
  std::int32_t cpu = -1;           ///< the processor to which the loop is pinned; -1: several
  std::uint64_t late_wakeups = 0;  ///< overruns whose wake-up latency exceeded their run time
  double wakeup_latency_min = kNotKnown;   ///< [s]
  double wakeup_latency_mean = kNotKnown;  ///< [s]
  double wakeup_latency_p999 = kNotKnown;  ///< [s]
  double execution_min = kNotKnown;        ///< [s], of one step of everything
  double execution_mean = kNotKnown;       ///< [s]
  double execution_p999 = kNotKnown;       ///< [s]
  std::string waits_for;  ///< in lockstep: the nodes that it waits for at present; empty: none
  // One entry for each of its systems, and one for its controllers if it has any; since the start
  // or the last reset of the statistics. Added later still: absent from older logs.
  std::vector<std::string> timed;
  std::vector<double> step_mean;  ///< [s], its time in a complete step
  std::vector<double> step_max;   ///< [s]
  std::vector<double>
      long_steps;  ///< overruns, other than by wake-up latency, in which it took most of the time

  template <class Visit>
  static void fields(Visit& visit) {
    const auto count = between(0, std::numeric_limits<std::int64_t>::max());
    const auto system = TWIN_FIELD(system);
    visit.head();
    visit(TWIN_FIELD(step_size), "s");
    visit(TWIN_FIELD(policy), "", requireText);
    visit(TWIN_FIELD(priority), "");
    visit(TWIN_FIELD(memory_locked), "", requireFlag);
    visit(TWIN_FIELD(kernel), "", requireText);
    visit(TWIN_FIELD(paused), "", requireFlag);
    visit(TWIN_FIELD(overruns), "", count);
    visit(TWIN_FIELD(skipped_steps), "", count);
    visit(TWIN_FIELD(dropped_snapshots), "", count);
    visit(TWIN_FIELD(page_faults), "", count);
    visit.numbers("s", TWIN_FIELD(wakeup_latency_p50), TWIN_FIELD(wakeup_latency_p99),
                  TWIN_FIELD(wakeup_latency_max), TWIN_FIELD(execution_p50),
                  TWIN_FIELD(execution_p99), TWIN_FIELD(execution_max), TWIN_FIELD(period_min),
                  TWIN_FIELD(period_max));
    visit.array(TWIN_FIELD(systems), system, "", each(requireName), Stays::kSame);
    visit.along(system, TWIN_FIELD(integrator), "", each(requireText));
    visit.along(system, TWIN_FIELD(error_estimate), "-");
    visit.along(system, TWIN_FIELD(tolerance), "-");
    visit.along(system, TWIN_FIELD(stopped), "", each(between(0, 5)));
    visit.along(system, TWIN_FIELD(stopped_why), "", each(requireText));
    visit(TWIN_FIELD(started), "ns", between(0, kMaxStamp));
    visit(TWIN_FIELD(epoch), "", count);
    visit(TWIN_FIELD(lcm_failed), "", count);
    visit(TWIN_FIELD(publish_every), "", count);
    visit.numbers("-", TWIN_FIELD(real_time_factor), TWIN_FIELD(achieved_factor));
    visit(TWIN_FIELD(ros_lost), "", count);
    visit(TWIN_FIELD(sender), "", requireText);
    const auto external = TWIN_FIELD(external);
    visit.array(TWIN_FIELD(externals), external, "", each(requireName), Stays::kSame);
    visit.along(external, TWIN_FIELD(age_p50), "");
    visit.along(external, TWIN_FIELD(age_p99), "");
    visit.along(external, TWIN_FIELD(age_max), "");
    visit(TWIN_FIELD(cpu), "");
    visit(TWIN_FIELD(late_wakeups), "", count);
    visit.numbers("s", TWIN_FIELD(wakeup_latency_min), TWIN_FIELD(wakeup_latency_mean),
                  TWIN_FIELD(wakeup_latency_p999), TWIN_FIELD(execution_min),
                  TWIN_FIELD(execution_mean), TWIN_FIELD(execution_p999));
    visit(TWIN_FIELD(waits_for), "", requireText);
    const auto timed = TWIN_FIELD(timed);
    visit.array(TWIN_FIELD(parts), timed, "", each(requireText), Stays::kSame);
    visit.along(timed, TWIN_FIELD(step_mean), "s");
    visit.along(timed, TWIN_FIELD(step_max), "s");
    visit.along(timed, TWIN_FIELD(long_steps), "");
  }
};

}  // namespace whirl_twin::state

namespace whirl_twin {

// Finds the system that causes most of the deadline misses.

/// The subsystem that caused most long steps, or that takes most of a step where there were none:
/// "rotor: 3.1 us of a step, at most 1204.7 us; took most of 12 long steps". "" where nothing was
/// timed.
std::string slowestPart(const state::LoopStatistics& loop);

}  // namespace whirl_twin

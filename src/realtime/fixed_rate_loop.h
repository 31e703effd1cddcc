// A thread that runs one function at a fixed rate: the real-time thread of the simulation.
//
//   wake-up k is due at t0 + k period on CLOCK_MONOTONIC, in integer nanoseconds; the thread sleeps
//   to that absolute instant (or to Options::busy_wait before it), so a late cycle does not move
//   the ones after it
//
// Measured separately, for every cycle: wake-up latency (actual - scheduled), execution time (of
// the function), period (between wake-ups). Overruns: OverrunPolicy. System settings that the
// thread requires: realtime_setup.h. It guarantees no latency: that depends on the kernel.
#pragma once

#include <pthread.h>

#include <atomic>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <mutex>
#include <string>

#include "realtime/realtime_setup.h"
#include "realtime/timing_histogram.h"

namespace whirl_twin {

// Overrun policy of a fixed-rate loop: a cycle ends after the scheduled start of the next one.
//
//   skip       skip the missed periods and continue at the next instant of the same grid
//              scheduled + k period: the phase is kept, the simulated time falls behind the clock
//   catch_up   run the missed cycles back to back, at most max_catch_up of them; older ones are
//              skipped as above, so the loop is never further behind than that bound
//   stop       end the loop
//
// A pure function of integer nanoseconds, so that the policy is tested without a clock.

enum class OverrunPolicy { kSkip, kCatchUp, kStop };

/// Schedule after a cycle.
struct WakeUp {
  std::int64_t next = 0;      ///< [ns], when the next cycle is due; in the past while catching up
  std::uint64_t skipped = 0;  ///< periods skipped between the present cycle and the next
  bool overrun = false;       ///< the cycle ended after the next was due
  bool stop = false;          ///< the loop must end
};

/// The wake-up after a cycle that was due at `scheduled` and ended at `now` [ns, the same clock].
/// `period` [ns] is positive. `max_catch_up` [cycles] matters to kCatchUp only; 0 makes it kSkip.
/// Always: (next - scheduled) is a whole number (at least 1) of periods, namely skipped + 1.
constexpr WakeUp nextWakeUp(OverrunPolicy policy, std::int64_t scheduled, std::int64_t now,
                            std::int64_t period, std::uint64_t max_catch_up) noexcept {
  const std::int64_t due = scheduled + period;
  if (now <= due) {
    return {due, 0, false, false};
  }
  if (policy == OverrunPolicy::kStop) {
    return {due, 0, true, true};
  }
  // Number of instants of the grid from `due` on that have passed, rounded up.
  const std::uint64_t missed = static_cast<std::uint64_t>((now - due - 1) / period + 1);
  const std::uint64_t run_late = policy == OverrunPolicy::kCatchUp ? max_catch_up : 0;
  const std::uint64_t skipped = missed > run_late ? missed - run_late : 0;
  return {due + static_cast<std::int64_t>(skipped) * period, skipped, true, false};
}

/// "skip", "catch_up" or "stop".
std::string toString(OverrunPolicy policy);

/// The inverse of toString. Throws InputError with the name found and those expected.
OverrunPolicy parseOverrunPolicy(const std::string& name);

/// Timing statistics of a loop. The histograms exclude the warm-up cycles; the counts do not.
struct LoopTiming {
  TimingHistogram wake_up_latency;  ///< [ns], actual minus scheduled wake-up
  TimingHistogram execution_time;   ///< [ns], of the cycle function
  TimingHistogram period;           ///< [ns], from one wake-up to the next
  std::uint64_t cycles = 0;         ///< cycles run since the start or the last reset
  std::uint64_t overruns = 0;       ///< of these, ended after the next one was due
  std::uint64_t late_wake_ups = 0;  ///< overruns whose wake-up latency exceeded their run time
  std::uint64_t skipped = 0;        ///< periods skipped
  /// Of the loop's thread since it started, as of some cycles ago; not reset.
  std::uint64_t page_faults = 0;
};

class FixedRateLoop {
 public:
  /// One cycle. Its argument is its scheduled start [ns, CLOCK_MONOTONIC]; false ends the loop. It
  /// must not block, allocate or throw (an exception ends the loop, and status() reports it). Of
  /// this class it may call stop(), running(), timing() and resetTiming().
  using Cycle = std::function<bool(std::int64_t scheduled)>;

  struct Options {
    std::int64_t period = 1'000'000;  ///< [ns], 10 us to 1 h
    RealtimeMode mode = RealtimeMode::kWarn;
    int priority = 50;  ///< SCHED_FIFO priority, 1 to 98: 99 belongs to the kernel's watchdogs
    OverrunPolicy policy = OverrunPolicy::kSkip;
    std::uint64_t max_catch_up = 10;     ///< [cycles], for OverrunPolicy::kCatchUp
    std::size_t stack_size = 1'048'576;  ///< [bytes], of the loop's thread
    std::uint64_t warm_up_cycles = 10;   ///< excluded from the histograms
    int cpu = -1;                        ///< the processor that the thread keeps to; -1: any
    std::int64_t give_up = 0;  ///< [ns] of continuous overruns after which the loop ends; 0: never
    /// [ns], up to half a period: duration of busy waiting before a cycle is due, where the
    /// kernel's wake-up takes a large part of the period. It uses that fraction of a processor.
    std::int64_t busy_wait = 0;
  };

  /// Throws InputError with the name of an option that is out of range.
  explicit FixedRateLoop(const Options& options);
  ~FixedRateLoop();
  FixedRateLoop(const FixedRateLoop&) = delete;
  FixedRateLoop& operator=(const FixedRateLoop&) = delete;

  /// Locks memory, starts the thread, waits until its scheduling is set, and returns; the first
  /// cycle is due one period later. Throws RunFailure when the thread cannot be started as
  /// RealtimeMode::kEnforce requires (nothing runs then), std::logic_error when it already runs. A
  /// loop that has ended can be started again; its timing restarts.
  void start(Cycle cycle);

  /// Ends the loop after the current cycle and joins the thread: within 50 ms plus that cycle. From
  /// inside a cycle it only requests the end.
  void stop() noexcept;

  bool running() const noexcept { return running_.load(std::memory_order_acquire); }

  /// The loop has ended because it overran for as long as Options::give_up.
  bool gaveUp() const noexcept { return gave_up_.load(std::memory_order_acquire); }

  /// The settings obtained from the system at the last start.
  RealtimeStatus status() const;

  /// A consistent copy of the statistics, without effect on the loop. Any thread.
  LoopTiming timing() const;

  /// Resets the statistics (all but page_faults), before the next cycle and within 50 ms plus the
  /// current cycle.
  void resetTiming() noexcept;

 private:
  struct Launch;

  static void* enter(void* launch) noexcept;
  void run() noexcept;
  bool sleepUntil(std::int64_t instant) noexcept;
  void record(std::int64_t scheduled, std::int64_t woke, std::int64_t finished,
              const WakeUp& next) noexcept;
  void clearTiming() noexcept;
  void join() noexcept;

  const Options options_;
  Cycle cycle_;
  pthread_t thread_{};
  bool joinable_ = false;
  RealtimeStatus status_;
  std::string
      failure_;  // the exception of a cycle: written by the loop's thread before running_ is false
  mutable std::mutex control_mutex_;  // start, stop and status; never locked by the loop
  std::atomic<bool> running_{false};
  std::atomic<bool> stop_requested_{false};
  std::atomic<bool> reset_requested_{false};
  std::atomic<bool> gave_up_{false};

  // Written by the loop's thread alone, between two increments of the sequence count.
  std::atomic<std::uint64_t> sequence_{0};
  TimingHistogram wake_up_latency_;
  TimingHistogram execution_time_;
  TimingHistogram period_;
  std::atomic<std::uint64_t> cycles_{0};
  std::atomic<std::uint64_t> overruns_{0};
  std::atomic<std::uint64_t> late_wake_ups_{0};
  std::atomic<std::uint64_t> skipped_{0};
  std::atomic<std::uint64_t> page_faults_{0};
  std::uint64_t warm_up_left_ = 0;
  std::int64_t woke_before_ = 0;
};

}  // namespace whirl_twin

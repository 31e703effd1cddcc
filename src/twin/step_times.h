// Computing time of each part of a twin per step (each system; all controllers together), and the
// part that was longest in steps that ended too late. Measured in wall time: a preemption counts
// for the part it interrupts; a small mean of that part reveals it.
//
// A reading of the clock takes 20 to 50 ns. The fraction of timed steps is chosen so that this
// costs less than a thousandth of the periods; with several steps in a period one in 64 is timed.
#pragma once

#include <atomic>
#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

#include "realtime/monotonic_clock.h"

namespace whirl_twin {

class StepTimes {
 public:
  /// Of one part, since the start or the last reset.
  struct Taken {
    double mean = 0.0;             ///< [ns] per step; 0: none was timed
    std::int64_t longest = 0;      ///< [ns]
    std::uint64_t long_steps = 0;  ///< late steps in which it was the longest part
  };

  /// period [ns]: of the loop.
  StepTimes(std::size_t parts, std::int64_t period);

  std::size_t parts() const { return parts_.size(); }
  /// Any thread.
  Taken of(std::size_t part) const noexcept;
  /// From any thread: resets all statistics before the next cycle.
  void reset() noexcept { reset_requested_.store(true, std::memory_order_relaxed); }

  // The loop's thread. Real-time safe.

  void beginCycle() noexcept;
  /// Whether the next step is timed.
  bool isDue(bool several) noexcept {
    if (--left_ > 0) {
      return false;
    }
    left_ = several && stride_ < kOfSeveral ? kOfSeveral : stride_;
    return true;
  }
  void beginStep() noexcept {
    marked_ = monotonicNow();
    if (begun_ == 0) {
      begun_ = marked_;
    }
  }
  /// Assigns the time since the last mark to this part.
  void mark(std::size_t part) noexcept {
    const std::int64_t now = monotonicNow();
    parts_[part].step += now - marked_;
    marked_ = now;
  }
  void endStep() noexcept;
  /// scheduled [ns]: due time of the cycle.
  void endCycle(std::int64_t scheduled) noexcept;

 private:
  static constexpr std::int64_t kOfSeveral = 64;  // steps

  struct Part {
    // Written by the loop only, read by any thread.
    std::atomic<std::uint64_t> count{0};
    std::atomic<std::int64_t> sum{0};      // [ns]
    std::atomic<std::int64_t> longest{0};  // [ns]
    std::atomic<std::uint64_t> long_steps{0};
    std::int64_t step = 0;   // [ns], of the timed step
    std::int64_t cycle = 0;  // [ns], sum of the cycle
  };

  std::vector<Part> parts_;
  std::int64_t period_;     // [ns]
  std::int64_t stride_;     // steps
  std::int64_t left_ = 1;   // steps until the next timed one
  std::int64_t begun_ = 0;  // [ns], start of the cycle; 0: none yet
  std::int64_t marked_ = 0;
  std::atomic<bool> reset_requested_{false};
};

/// Marks of a step that is not timed.
struct NoMarks {
  void operator()(std::size_t) const noexcept {}
};

/// Marks of a timed step.
struct TimingMarks {
  StepTimes& times;
  void operator()(std::size_t part) const noexcept { times.mark(part); }
};

}  // namespace whirl_twin

// What each part of a twin takes of its steps (its systems; its controllers together), and of which
// of them a step was that ended too late. Of wall time: what preempts the loop counts for whom it
// hits, whose mean tells that it is another's fault.
//
// A look at the clock takes 20 to 50 ns. So as many steps are timed as keep that below a thousandth
// of the periods, and one of 64 where there are several in a period.
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
    double mean = 0.0;         ///< [ns] a step; 0: none was timed
    std::int64_t longest = 0;  ///< [ns]
    std::uint64_t long_steps =
        0;  ///< of the steps that ended too late, those of which it took most
  };

  /// period [ns]: of the loop.
  StepTimes(std::size_t parts, std::int64_t period);

  std::size_t parts() const { return parts_.size(); }
  /// Any thread.
  Taken of(std::size_t part) const noexcept;
  /// Any thread: all begin anew, before the next cycle.
  void reset() noexcept { reset_requested_.store(true, std::memory_order_relaxed); }

  // The loop's thread. Real-time safe.

  void beginCycle() noexcept;
  /// Whether the step that follows is to be timed.
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
  /// What has gone by since the last mark was this part's.
  void mark(std::size_t part) noexcept {
    const std::int64_t now = monotonicNow();
    parts_[part].step += now - marked_;
    marked_ = now;
  }
  void endStep() noexcept;
  /// scheduled [ns]: when the cycle was due.
  void endCycle(std::int64_t scheduled) noexcept;

 private:
  static constexpr std::int64_t kOfSeveral = 64;  // steps

  struct Part {
    // Written by the loop alone, read by any.
    std::atomic<std::uint64_t> count{0};
    std::atomic<std::int64_t> sum{0};      // [ns]
    std::atomic<std::int64_t> longest{0};  // [ns]
    std::atomic<std::uint64_t> long_steps{0};
    std::int64_t step = 0;   // [ns], of the step that is being timed
    std::int64_t cycle = 0;  // [ns], of those of the cycle
  };

  std::vector<Part> parts_;
  std::int64_t period_;     // [ns]
  std::int64_t stride_;     // steps
  std::int64_t left_ = 1;   // steps to the next that is timed
  std::int64_t begun_ = 0;  // [ns], first of the cycle; 0: none yet
  std::int64_t marked_ = 0;
  std::atomic<bool> reset_requested_{false};
};

/// The marks of a step that nobody times.
struct NoMarks {
  void operator()(std::size_t) const noexcept {}
};

/// Those of one that is timed.
struct TimingMarks {
  StepTimes& times;
  void operator()(std::size_t part) const noexcept { times.mark(part); }
};

}  // namespace whirl_twin

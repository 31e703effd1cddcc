// Barrier of the loop: it may step only as far as external participants, who must keep up with it,
// have permitted.
//
// A permission is valid for its run only, from one reset to the next: a permission for the previous
// run has no effect in the next one.
#pragma once

#include <atomic>
#include <cstdint>

namespace whirl_twin {

class StepBarrier {
 public:
  /// Open until the first hold().
  StepBarrier() = default;

  // Called by one other thread, before the loop runs or while it does.

  /// Permits no step of the run.
  void hold(std::uint64_t run) noexcept { allow(run, kNothing); }
  /// Permits steps up to this one of a run (0: before the first reset).
  void allow(std::uint64_t run, std::int64_t step) noexcept;
  /// All steps, of any run.
  void open() noexcept { handed_out_.store(kOpen, std::memory_order_release); }

  // Called by the loop's thread. Real-time safe.

  /// A run begins at its start.
  void beginRun() noexcept { ++run_; }
  bool isOpen() const noexcept { return handed_out_.load(std::memory_order_acquire) == kOpen; }
  bool lets(std::int64_t step) const noexcept;
  /// May the initial state be published? Always after a reset.
  bool letsStart(std::int64_t step) const noexcept { return run_ > 0 || lets(step); }
  /// Sleeps in short intervals until the step is permitted or the clock [ns, CLOCK_MONOTONIC] has
  /// reached `end`; true if it is permitted.
  bool waitFor(std::int64_t step, std::int64_t end) const noexcept;

 private:
  static constexpr std::int64_t kNothing = -1;
  static constexpr std::uint64_t kOpen = ~std::uint64_t{0};
  static constexpr int kStepBits = 44;  // 50 years at 10 kHz
  static constexpr std::uint64_t kRuns = (std::uint64_t{1} << (64 - kStepBits)) - 1;

  static std::uint64_t packed(std::uint64_t run, std::int64_t step) noexcept;

  std::atomic<std::uint64_t> handed_out_{kOpen};  // run and permitted steps, in one word
  std::uint64_t run_ = 0;
};

}  // namespace whirl_twin

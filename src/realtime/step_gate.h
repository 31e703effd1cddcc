// How far the loop may step: a step that others hand out, who have to keep up with it.
//
// A step counts in its run alone, from one reset to the next: what was handed out for the run
// before opens nothing in the next one.
#pragma once

#include <atomic>
#include <cstdint>

namespace whirl_twin {

class StepGate {
 public:
  /// Open until it is first asked to hold.
  StepGate() = default;

  // One other thread, before the loop runs or while it does.

  /// Nothing of the run is handed out.
  void hold(std::uint64_t run) noexcept { allow(run, kNothing); }
  /// Steps up to this one of a run (0: before the first reset) may be done.
  void allow(std::uint64_t run, std::int64_t step) noexcept;
  /// All steps, of any run.
  void open() noexcept { handed_out_.store(kOpen, std::memory_order_release); }

  // The loop's thread. Real-time safe.

  /// A run begins at its start.
  void beginRun() noexcept { ++run_; }
  bool isOpen() const noexcept { return handed_out_.load(std::memory_order_acquire) == kOpen; }
  bool lets(std::int64_t step) const noexcept;
  /// May it tell where it stands? What a reset has begun nobody holds back.
  bool letsStart(std::int64_t step) const noexcept { return run_ > 0 || lets(step); }
  /// Sleeps in short turns until the step may be done or the clock [ns, CLOCK_MONOTONIC] has
  /// reached `end`; true if it may.
  bool waitFor(std::int64_t step, std::int64_t end) const noexcept;

 private:
  static constexpr std::int64_t kNothing = -1;
  static constexpr std::uint64_t kOpen = ~std::uint64_t{0};
  static constexpr int kStepBits = 44;  // 50 years at 10 kHz
  static constexpr std::uint64_t kRuns = (std::uint64_t{1} << (64 - kStepBits)) - 1;

  static std::uint64_t packed(std::uint64_t run, std::int64_t step) noexcept;

  std::atomic<std::uint64_t> handed_out_{kOpen};  // run and steps that may be done, in one
  std::uint64_t run_ = 0;
};

}  // namespace whirl_twin

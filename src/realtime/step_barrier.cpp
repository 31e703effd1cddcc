#include "realtime/step_barrier.h"

#include <time.h>

#include <algorithm>

#include "realtime/monotonic_clock.h"

namespace whirl_twin {

namespace {

constexpr std::int64_t kShortestTurn = 20'000;  // [ns]
constexpr std::int64_t kMaxTurn = 200'000;      // [ns]

}  // namespace

/// The run and the number of permitted steps, counted from 0, in one word. Runs a multiple of about
/// a million apart are indistinguishable.
std::uint64_t StepBarrier::packed(std::uint64_t run, std::int64_t step) noexcept {
  const std::int64_t count =
      std::clamp<std::int64_t>(step, kNothing, (std::int64_t{1} << kStepBits) - 2) + 1;
  return (run % kRuns) << kStepBits | static_cast<std::uint64_t>(count);
}

void StepBarrier::allow(std::uint64_t run, std::int64_t step) noexcept {
  handed_out_.store(packed(run, step), std::memory_order_release);
}

bool StepBarrier::lets(std::int64_t step) const noexcept {
  const std::uint64_t handed_out = handed_out_.load(std::memory_order_acquire);
  return handed_out == kOpen ||
         (handed_out >> kStepBits == run_ % kRuns && handed_out >= packed(run_, step));
}

bool StepBarrier::waitFor(std::int64_t step, std::int64_t end) const noexcept {
  std::int64_t turn = kShortestTurn;
  while (!lets(step)) {
    const std::int64_t left = end - monotonicNow();
    if (left <= 0) {
      return false;
    }
    const timespec rest{0, std::min(turn, left)};
    clock_nanosleep(CLOCK_MONOTONIC, 0, &rest, nullptr);
    turn = std::min(2 * turn, kMaxTurn);
  }
  return true;
}

}  // namespace whirl_twin

// What a fixed-rate loop does when a cycle ends after the next one should have begun (an overrun).
//
//   skip       leave out the missed periods and go on at the next instant of the same grid
//              scheduled + k period: the phase is kept, the simulated time falls behind the clock
//   catch_up   run the missed cycles back to back, at most max_catch_up of them; older ones are
//              skipped as above, so the loop is never further behind than that bound
//   stop       end the loop
//
// A pure function of integer nanoseconds, so that the policy is tested without a clock.
#pragma once

#include <cstdint>
#include <string>

namespace whirl_twin {

enum class OverrunPolicy { kSkip, kCatchUp, kStop };

/// What follows a cycle.
struct WakeUp {
  std::int64_t next = 0;      ///< [ns], when the next cycle is due; in the past while catching up
  std::uint64_t skipped = 0;  ///< periods left out between the cycle done and the next
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
  // Instants of the grid from `due` on that have passed already, rounded up.
  const std::uint64_t missed = static_cast<std::uint64_t>((now - due - 1) / period + 1);
  const std::uint64_t run_late = policy == OverrunPolicy::kCatchUp ? max_catch_up : 0;
  const std::uint64_t skipped = missed > run_late ? missed - run_late : 0;
  return {due + static_cast<std::int64_t>(skipped) * period, skipped, true, false};
}

/// "skip", "catch_up" or "stop".
std::string toString(OverrunPolicy policy);

/// The reverse of toString; Refusal names what was found and what is expected.
OverrunPolicy parseOverrunPolicy(const std::string& name);

}  // namespace whirl_twin

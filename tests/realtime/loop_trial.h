// Shared by the tests of the fixed-rate loop: a loop that requires no scheduling rights, and a
// clock.
#pragma once

#include <gtest/gtest.h>
#include <time.h>

#include <chrono>
#include <cstdint>
#include <thread>

#include "realtime/fixed_rate_loop.h"

namespace whirl_twin {

inline constexpr std::int64_t kPeriod = 1'000'000;  // [ns]

inline std::int64_t monotonicNow() {
  timespec now{};
  clock_gettime(CLOCK_MONOTONIC, &now);
  return now.tv_sec * std::int64_t{1'000'000'000} + now.tv_nsec;
}

inline void busyUntil(std::int64_t instant) {
  while (monotonicNow() < instant) {
  }
}

inline FixedRateLoop::Options ordinary(OverrunPolicy policy = OverrunPolicy::kSkip) {
  FixedRateLoop::Options options;
  options.period = kPeriod;
  options.mode = RealtimeMode::kIgnore;
  options.policy = policy;
  options.warm_up_cycles = 0;
  return options;
}

// Waits until the loop has ended without stop(). (The minute only ends a hang.)
inline void waitForEnd(const FixedRateLoop& loop) {
  const std::int64_t give_up = monotonicNow() + 60'000'000'000;
  while (loop.running() && monotonicNow() < give_up) {
    std::this_thread::sleep_for(std::chrono::milliseconds(1));
  }
  ASSERT_FALSE(loop.running());
}

}  // namespace whirl_twin

// The clock of the loop: monotonic, unaffected by adjustments of the wall clock.
#pragma once

#include <time.h>

#include <cstdint>

namespace whirl_twin {

/// [ns], CLOCK_MONOTONIC. Real-time safe: no system call on Linux (vdso).
inline std::int64_t monotonicNow() noexcept {
  timespec now{};
  clock_gettime(CLOCK_MONOTONIC, &now);
  return now.tv_sec * 1'000'000'000LL + now.tv_nsec;
}

}  // namespace whirl_twin

// Wall-clock times in readable form.
#pragma once

#include <cstdint>
#include <string>

namespace whirl_twin {

/// [ns] since 1970, now.
std::int64_t wallClock();

/// "2026-03-01T14:03:12.345Z" (ISO 8601, UTC) of [ns] since 1970.
std::string isoTime(std::int64_t stamp);

/// Is a stamp [ns] of the wall clock? Simulated time counts from 0, and no run is that long.
constexpr bool isOfWallClock(std::int64_t stamp) {
  return stamp > 1'000'000'000'000'000'000;
}

}  // namespace whirl_twin

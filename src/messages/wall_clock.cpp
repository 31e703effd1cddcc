#include "messages/wall_clock.h"

#include <fmt/chrono.h>
#include <fmt/format.h>

#include <chrono>
#include <ctime>

namespace whirl_twin {

std::int64_t wallClock() {
  return std::chrono::duration_cast<std::chrono::nanoseconds>(
             std::chrono::system_clock::now().time_since_epoch())
      .count();
}

std::string isoTime(std::int64_t stamp) {
  constexpr std::int64_t kMillisecond = 1'000'000, kSecond = 1'000'000'000;
  const std::int64_t rest = ((stamp % kSecond) + kSecond) % kSecond;
  const std::time_t seconds = (stamp - rest) / kSecond;
  return fmt::format("{:%Y-%m-%dT%H:%M:%S}.{:03}Z", fmt::gmtime(seconds), rest / kMillisecond);
}

}  // namespace whirl_twin

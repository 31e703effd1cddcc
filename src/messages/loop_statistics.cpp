#include "messages/loop_statistics.h"

#include <fmt/format.h>

#include <tuple>

namespace whirl_twin {

std::string slowestPart(const state::LoopStatistics& loop) {
  if (loop.timed.empty()) {
    return "";
  }
  std::size_t slowest = 0;
  for (std::size_t i = 1; i < loop.timed.size(); ++i) {
    if (std::tie(loop.long_steps[i], loop.step_mean[i]) >
        std::tie(loop.long_steps[slowest], loop.step_mean[slowest])) {
      slowest = i;
    }
  }
  if (!(loop.step_max[slowest] > 0.0)) {
    return "";
  }
  return fmt::format("{}: {:.1f} us of a step, at most {:.1f} us; took most of {:.0f} long steps",
                     loop.timed[slowest], 1.0e6 * loop.step_mean[slowest],
                     1.0e6 * loop.step_max[slowest], loop.long_steps[slowest]);
}

}  // namespace whirl_twin

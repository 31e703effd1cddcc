// What a monitor that comes back has to know: which alerts were there, and in which run of time.
#pragma once

#include <cstdint>
#include <optional>
#include <utility>
#include <vector>

#include "monitoring/alert_list.h"

namespace whirl_twin {

/// A run of simulated time: when the simulation was started [ns, wall], and its resets since.
using TwinRun = std::pair<std::int64_t, std::uint64_t>;

struct AlarmMemory {
  std::vector<state::Alert> alerts;  ///< active or latched
  std::uint32_t last_id = 0;
  AlertList::Counts counts;    ///< of each kind, how often it was raised
  std::optional<TwinRun> run;  ///< none if the simulation never told
};

}  // namespace whirl_twin

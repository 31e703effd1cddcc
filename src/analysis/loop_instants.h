// When controllers read and when their outputs act, over one period common to all.
#pragma once

#include <cstdint>
#include <vector>

#include "analysis/sampled_loop.h"

namespace whirl_twin {

struct LoopEvent {
  std::int64_t tick = 0;
  bool acts = false;  ///< an output comes into force; else the controller reads
  std::size_t controller = 0;
};

struct LoopInstants {
  double tick = 0.0;        ///< s
  std::int64_t period = 0;  ///< ticks
  bool whole_nanoseconds = false;
  std::vector<int> samples;  ///< of each controller in the period
  std::vector<int>
      on_the_way;          ///< outputs of each computed before the period that act in it, or later
  std::vector<bool> held;  ///< an output of before the period is in force as it begins
  std::vector<LoopEvent> events;  ///< in order; at one instant all read before any acts
};

/// Errors as sampledLoop().
LoopInstants loopInstants(const std::vector<LoopController>& controllers);

}  // namespace whirl_twin

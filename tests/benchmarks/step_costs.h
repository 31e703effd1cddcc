// The CPU time of a step of several systems, measured in interleaved rounds, so that all run under
// the same load of the machine.
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "twin/twin.h"

namespace whirl_twin {

struct Stepped {
  std::string name;
  std::function<void(int)> advance;  ///< by so many steps
};

/// [ns] a step, over the rounds.
struct StepCost {
  double median = 0.0;
  double lower_quartile = 0.0, upper_quartile = 0.0;
};

struct Effort {
  int rounds;
  double turn_ms;  ///< minimum CPU time of a round
};

/// Of each, in their order.
std::vector<StepCost> stepCosts(const std::vector<Stepped>& all, const Effort& effort);

/// Advances a twin, which starts again every 14 000 steps: before a run-up of 15 s at 1 ms ends.
/// Throws std::runtime_error if a system has stopped.
void advance(Twin& twin, int steps);

}  // namespace whirl_twin

// A coupling of ROSS: springs between two nodes and what its ends weigh.
#pragma once

#include <string>
#include <vector>

#include "reports/ross_file.h"
#include "reports/rotor_drawing.h"

namespace whirl_twin {

struct RossCoupling {
  DrawnRow row;                ///< of couplings
  std::vector<DrawnRow> hubs;  ///< of discs, at its two nodes
  std::vector<std::string> left_out;
};

/// The one from `node` to the next, whose element has the same number.
RossCoupling rossCoupling(RossFile& file, const RossEntry& entry, int node);

}  // namespace whirl_twin

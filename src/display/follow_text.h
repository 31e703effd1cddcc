// What a display says of a system that follows its machine.
#pragma once

#include <string>
#include <vector>

#include "whirl_twin/FollowState.h"

namespace whirl_twin {

/// A line for each estimated parameter, "coulomb1 0.00029 +- 6e-05 N m"; then each channel that is
/// not used, and how far the residuals are from what is expected.
std::vector<std::string> followLines(const FollowState& follow);

}  // namespace whirl_twin

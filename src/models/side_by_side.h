// Models whose members an ensemble can step side by side in vectors.
#pragma once

#include <memory>
#include <vector>

#include "integration/member_steps.h"
#include "mechanics/dynamics.h"

namespace whirl_twin {

/// The equations of members, at least one, of one model; nullptr: of another kind, or not of one.
std::unique_ptr<MemberEquations> memberEquations(const std::vector<const Dynamics*>& members);

}  // namespace whirl_twin

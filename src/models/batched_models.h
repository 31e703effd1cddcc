// Models that an ensemble can step as a batch in SIMD vectors.
#pragma once

#include <memory>
#include <vector>

#include "integration/batch_runge_kutta.h"
#include "mechanics/dynamics.h"

namespace whirl_twin {

/// The equations of members, at least one, of one model; nullptr: of another kind, or not of one.
std::unique_ptr<BatchEquations> batchEquations(const std::vector<const Dynamics*>& members);

}  // namespace whirl_twin

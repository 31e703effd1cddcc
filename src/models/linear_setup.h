// The setup of a model that is a linear system given by its matrices.
#pragma once

#include "mechanics/linear_dynamics.h"
#include "models/model_info.h"

namespace whirl_twin {

/// A setup that steps with every method of linear systems. Throws Refusal as
/// LinearDynamics does.
ModelSetup linearSetup(LinearModel model);

}  // namespace whirl_twin

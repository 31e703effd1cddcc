// The setup of a model whose dynamics are a linear rotor, or that steps as one in a run-up.
#pragma once

#include <memory>

#include "integration/jacobi_integral.h"
#include "mechanics/dynamics.h"
#include "models/model_info.h"

namespace whirl_twin {

/// The setup of a model whose dynamics are a linear rotor: it steps with `exponential`, at constant
/// and at changing speed.
ModelSetup linearRotorSetup(std::shared_ptr<const Dynamics> dynamics);

/// A setup of a linear model with a shaft, in the fixed frame, whose `exponential` follows a
/// changing speed: of two coordinates without inputs by LateralRotorStepper, else by that step.
ModelSetup withExactRunUps(ModelSetup setup, JacobiIntegral jacobi);

}  // namespace whirl_twin

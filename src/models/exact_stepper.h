// The exact step of a linear model by its matrices, at constant and at changing speed.
#pragma once

#include <memory>

#include "integration/jacobi_integral.h"
#include "integration/step_context.h"
#include "integration/stepper.h"
#include "mechanics/dynamics.h"

namespace whirl_twin {

/// Of dynamics in the fixed frame, or at constant speed in one that turns; `jacobi` as that of
/// LinearRotorStepper.
std::unique_ptr<Stepper> exactStepper(std::shared_ptr<const Dynamics> dynamics,
                                      JacobiIntegral jacobi, const StepContext& excitation,
                                      double step, int substeps);

}  // namespace whirl_twin

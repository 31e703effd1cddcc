// A linear rotor given by its matrices as a system that steps, and the setup of a model made so.
#pragma once

#include <memory>

#include "mechanics/dynamics.h"
#include "scene/model_info.h"

namespace whirl_twin {

/// The setup of a model whose dynamics are a linear rotor: it steps with `exponential`, at constant
/// and at changing speed.
ModelSetup linearRotorSetup(std::shared_ptr<const Dynamics> dynamics);

}  // namespace whirl_twin

// Small systems that one looks for by name, as models.h: one function a model, each in a
// translation unit of its own.
#pragma once

#include "models/model_info.h"

namespace whirl_twin {

ModelInfo elasticPendulumInfo();
ModelInfo foucaultPendulumInfo();
ModelInfo kapitzaPendulumInfo();
ModelInfo massSpringDamperInfo();

}  // namespace whirl_twin

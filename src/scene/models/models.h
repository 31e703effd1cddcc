// One function a model, each in a translation unit of its own: that is where its steps are
// compiled.
#pragma once

#include "scene/model_info.h"

namespace whirl_twin {

ModelInfo jeffcottRotorInfo();
ModelInfo spinningPendulumInfo();
ModelInfo doublePendulumInfo();

}  // namespace whirl_twin

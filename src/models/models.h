// One function a model, each in a translation unit of its own: that is where its steps are
// compiled.
#pragma once

#include "models/model_info.h"

namespace whirl_twin {

ModelInfo cantileverBeamInfo();
ModelInfo cartPendulumInfo();
ModelInfo doublePendulumInfo();
ModelInfo flexibleRotorInfo();
ModelInfo freeRotorInfo();
ModelInfo frictionOscillatorInfo();
ModelInfo governorInfo();
ModelInfo hingedBeamInfo();
ModelInfo jeffcottRotorInfo();
ModelInfo linearSystemInfo();
ModelInfo pendulumInfo();
ModelInfo rigidDiscRotorInfo();
ModelInfo rodSliderInfo();
ModelInfo rollingDiscInfo();
ModelInfo rotatingPendulumInfo();
ModelInfo slidingMassFlywheelInfo();
ModelInfo spinningPendulumInfo();
ModelInfo sprungInvertedPendulumInfo();
ModelInfo twoBarLinkageInfo();

}  // namespace whirl_twin

// One function per model, each in a separate translation unit, where its steps are compiled.
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

// Small systems: one function per model, each in a separate translation unit.

ModelInfo elasticPendulumInfo();
ModelInfo foucaultPendulumInfo();
ModelInfo kapitzaPendulumInfo();
ModelInfo massSpringDamperInfo();

// The forms of the Jeffcott rotor, each in a separate translation unit.

/// Each with the gravity and the motor of `around`.
ModelSetup setUpNonlinearJeffcott(const ParameterValues& values, const ModelContext& around);
ModelSetup setUpJournalJeffcott(const ParameterValues& values, const ModelContext& around);
/// With a motor, of which there must be one.
ModelSetup setUpSpinningJeffcott(const ParameterValues& values, const ModelContext& around);

ModelVariant nonlinearJeffcottVariant(const std::string& when);
ModelVariant journalJeffcottVariant(const std::string& when);
ModelVariant spinningJeffcottVariant(const std::string& when);

}  // namespace whirl_twin

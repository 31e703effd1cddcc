// The forms of the Jeffcott rotor, each in a translation unit of its own.
#pragma once

#include "models/model_info.h"

namespace whirl_twin {

/// Each with the gravity and the motor that `around` says.
ModelSetup setUpNonlinearJeffcott(const ParameterValues& values, const Surroundings& around);
ModelSetup setUpJournalJeffcott(const ParameterValues& values, const Surroundings& around);
/// With a motor, of which there must be one.
ModelSetup setUpSpinningJeffcott(const ParameterValues& values, const Surroundings& around);

ModelVariant nonlinearJeffcottVariant(const std::string& when);
ModelVariant journalJeffcottVariant(const std::string& when);
ModelVariant spinningJeffcottVariant(const std::string& when);

}  // namespace whirl_twin

// The shaft, discs, bearings and unbalances that a scene gives for a flexible_rotor.
#pragma once

#include <string>
#include <vector>

#include "mechanics/rotors/rotor_assembly.h"
#include "models/model_info.h"

namespace whirl_twin {

/// What a scene may give of a flexible rotor's shaft, by tables.
std::vector<SettingInfo> flexibleShaftSettings();

/// Throws SetupError for what does not fit together: where, what was expected, what was found.
FlexibleShaft flexibleShaft(const ParameterValues& values, const Settings& settings,
                            double gravity);

/// What is unusual about it, and what it takes for given.
std::vector<std::string> shaftNotes(const ParameterValues& values, const Settings& settings,
                                    const FlexibleShaft& shaft);

/// The nodes that have a whirl of their own. Throws SetupError for one that is not there, or twice.
std::vector<int> publishedNodes(const Settings& settings, const FlexibleShaft& shaft);

}  // namespace whirl_twin

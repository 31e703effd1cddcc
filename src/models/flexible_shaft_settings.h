// The shaft, discs, bearings and unbalances that a scene gives for a flexible_rotor.
#pragma once

#include <string>
#include <vector>

#include "mechanics/rotors/rotor_assembly.h"
#include "models/model_info.h"

namespace whirl_twin {

/// Settings of a flexible rotor's shaft in a scene, by tables.
std::vector<SettingInfo> flexibleShaftSettings();

/// Throws SetupError for what does not fit together: where, what was expected, what was found.
FlexibleShaft flexibleShaft(const ParameterValues& values, const Settings& settings,
                            double gravity);

/// Notes on unusual values and on assumptions.
std::vector<std::string> shaftNotes(const ParameterValues& values, const Settings& settings,
                                    const FlexibleShaft& shaft);

/// The nodes whose whirl is published separately. Throws SetupError for a missing or duplicate
/// node.
std::vector<int> publishedNodes(const Settings& settings, const FlexibleShaft& shaft);

}  // namespace whirl_twin

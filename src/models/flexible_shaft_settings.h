// The shaft, discs, bearings and unbalances that a scene gives for a flexible_rotor.
#pragma once

#include <vector>

#include "mechanics/rotors/rotor_assembly.h"
#include "models/magnet_settings.h"
#include "models/model_info.h"

namespace whirl_twin {

/// What a scene may give of a flexible rotor's shaft, by tables.
std::vector<SettingInfo> flexibleShaftSettings();

/// Throws SetupError for what does not fit together: where, what was expected, what was found.
FlexibleShaft flexibleShaft(const ParameterValues& values, const Settings& settings,
                            double gravity);

struct NodeMagnet {
  int node = 0;
  RotorMagnet magnet;
};

/// Of each what it adds to the shaft, its negative stiffness, is among the shaft's bearings.
/// Throws SetupError.
std::vector<NodeMagnet> nodeMagnets(const Settings& settings, int nodes);

/// The nodes that have a whirl of their own. Throws SetupError for one that is not there, or twice.
std::vector<int> publishedNodes(const Settings& settings, const FlexibleShaft& shaft);

}  // namespace whirl_twin

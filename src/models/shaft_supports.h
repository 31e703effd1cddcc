// Supports of a flexible rotor's shaft: bearings, the pedestals below them, active magnetic
// bearings.
#pragma once

#include <vector>

#include "mechanics/rotors/rotor_assembly.h"
#include "models/magnet_settings.h"
#include "models/settings.h"

namespace whirl_twin {

/// Tables of bearings, bearing_tables, journal_bearings and pedestals, and the magnets.
std::vector<SettingInfo> supportSettings();

/// Adds the bearings, the magnets' negative stiffnesses among them, and the pedestals. Throws
/// SetupError.
void addSupports(const Settings& settings, FlexibleShaft& shaft);

struct NodeMagnet {
  int node = 0;
  RotorMagnet magnet;
};

/// Of each what it adds to the shaft, its negative stiffness, is among the shaft's bearings.
/// Throws SetupError.
std::vector<NodeMagnet> nodeMagnets(const Settings& settings, int nodes);

}  // namespace whirl_twin

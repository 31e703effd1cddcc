// A rotor of a fixed number of coordinates on active magnetic bearings: its matrices include the
// linear part of the magnets; it is stepped as a linear rotor, with nodal forces for nonlinear
// magnets.
#pragma once

#include <memory>
#include <vector>

#include "models/magnet_settings.h"
#include "models/model_info.h"

namespace whirl_twin {

/// `plain`: the rotor without magnets, linear. Each magnet has a station `magnet_SUFFIX`.
ModelSetup levitatedRotorSetup(std::shared_ptr<const Dynamics> plain,
                               const std::vector<PlacedMagnet>& magnets);

}  // namespace whirl_twin

// A rotor of a fixed number of coordinates on magnetic bearings: its matrices with what the magnets
// add to them, stepped as a linear rotor, with forces at places where the magnets are not linear.
#pragma once

#include <memory>
#include <vector>

#include "models/magnet_settings.h"
#include "models/model_info.h"

namespace whirl_twin {

/// `plain`: the rotor without magnets, linear. Magnets have stations of their own, `magnet_SUFFIX`.
ModelSetup levitatedRotorSetup(std::shared_ptr<const Dynamics> plain,
                               const std::vector<PlacedMagnet>& magnets);

}  // namespace whirl_twin

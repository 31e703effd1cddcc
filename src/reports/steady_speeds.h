// What `twin analyze` adds of a rotor on a motor: the speeds at which it runs steadily.
#pragma once

#include <vector>

#include "analysis/sommerfeld_speeds.h"
#include "scene/built_system.h"

namespace whirl_twin {

/// Steady speeds of a rotor that a motor turns, by the linear rotor that it is at constant speed;
/// empty where there is no motor, or that rotor is not linear.
std::vector<SteadySpeed> steadySpeedsOf(const BuiltSystem& system);

}  // namespace whirl_twin

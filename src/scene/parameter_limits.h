// Parameters that are in range one by one and together make rates that no double carries: a mass of
// 5e-324 kg on a spring of 1e4 N/m.
#pragma once

#include <string>

#include "mechanics/dynamics.h"
#include "scene/scene.h"

namespace whirl_twin {

/// [1/s], of a system: damping over mass, and the root of stiffness over mass. The product of four
/// is a coefficient of a characteristic polynomial of two coordinates.
inline constexpr double kLargestRate = 1.0e75;

/// Why no evaluation of a system can be right, by the matrices of its small deviations where it
/// starts, at rest, with a shaft that turns at `speed` [rad/s]; "": they are within kLargestRate.
std::string objectionToRates(const Dynamics& dynamics, const SystemSpec& spec, double speed);

}  // namespace whirl_twin

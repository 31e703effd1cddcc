// What `twin analyze` adds of a rotor: how much cross-coupling it bears, and on a motor the speeds
// at which it runs steadily.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "analysis/sommerfeld_speeds.h"
#include "mechanics/dynamics.h"
#include "scene/built_system.h"

namespace whirl_twin {

/// Destabilizing cross-coupled stiffness at the published station at which the first forward mode
/// stops to decay (analysis/cross_coupling_margin.h).
struct CrossCouplingMargin {
  std::string station;
  std::optional<double> stiffness;  ///< [N/m]; none makes it grow
};

/// At a shaft speed [rad/s]. Nothing for what is not a linear rotor, or has more than
/// kMostCoupledCoordinates: each of some fifty steps towards the margin costs all its eigenvalues.
constexpr int kMostCoupledCoordinates = 64;
std::optional<CrossCouplingMargin> crossCouplingMarginOf(const Dynamics& dynamics, double speed);

/// Steady speeds of a rotor that a motor turns, by the linear rotor that it is at constant speed;
/// empty where there is no motor, or that rotor is not linear.
std::vector<SteadySpeed> steadySpeedsOf(const BuiltSystem& system);

}  // namespace whirl_twin

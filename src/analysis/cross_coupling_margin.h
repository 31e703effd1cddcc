// How much destabilizing cross-coupled stiffness a rotor bears (API 617 and API RP 684, level I):
// kxy = +Q, kyx = -Q [N/m] at one station, as seals and impellers have it, and the logarithmic
// decrement of the first forward mode over Q. It is zero at Q0, the margin. (Where the bearings,
// not gyroscopic moments, give modes their planes: the first that does not whirl backward.)
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "analysis/whirl_modes.h"
#include "mechanics/dynamics.h"
#include "mechanics/linear_rotor.h"

namespace whirl_twin {

/// The matrices with Q [N/m] at a station added to the circulatory ones.
Linearization withCrossCoupling(Linearization matrices, const Station& station,
                                double cross_coupling);

struct CrossCouplingRow {
  double cross_coupling = 0.0;  ///< Q [N/m]
  WhirlMode mode;               ///< the first forward one
};

/// The first forward mode over ascending Q [N/m], followed by its shape from Q = 0 on. Empty for a
/// rotor without a forward mode at this speed [rad/s].
std::vector<CrossCouplingRow> firstForwardMode(const LinearRotor& rotor,
                                               const std::vector<Station>& stations,
                                               std::size_t station, double speed,
                                               const std::vector<double>& cross_couplings);

/// Q0 [N/m] >= 0; 0 if the mode does not decay as it is, nothing if there is no such mode or no
/// cross-coupling up to 1e6 times the largest stiffness makes it grow.
std::optional<double> crossCouplingMargin(const LinearRotor& rotor,
                                          const std::vector<Station>& stations, std::size_t station,
                                          double speed);

/// At the published station of a system.
struct CrossCouplingMargin {
  std::string station;
  std::optional<double> stiffness;  ///< Q0 [N/m]; none makes it grow
};

/// At a shaft speed [rad/s]. Nothing for what is not a linear rotor, or has more than
/// kMostCoupledCoordinates: each of some fifty steps towards the margin costs all its eigenvalues.
constexpr int kMostCoupledCoordinates = 64;
std::optional<CrossCouplingMargin> crossCouplingMarginOf(const Dynamics& dynamics, double speed);

}  // namespace whirl_twin

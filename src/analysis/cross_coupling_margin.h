// How much destabilizing cross-coupled stiffness a rotor bears (API 617 and API RP 684, level I):
// kxy = +Q, kyx = -Q [N/m] at one station, as seals and impellers have it, and the logarithmic
// decrement over Q of the forward mode that decays slowest there. (Where the bearings, not
// gyroscopic moments, give modes their planes: of those that do not whirl backward.) Q0, the
// margin, is the least Q at which a mode ceases to decay. Modes are judged at each Q by themselves:
// between unlike bearings one that is forward without Q may be backward with it, and another
// forward. Only those that whirl count (isWhirl).
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
  WhirlMode mode;               ///< the forward one that decays slowest
};

/// The forward mode that decays slowest at each Q [N/m] that has a forward mode at this speed
/// [rad/s].
std::vector<CrossCouplingRow> slowestForwardMode(const LinearRotor& rotor,
                                                 const std::vector<Station>& stations,
                                                 std::size_t station, double speed,
                                                 const std::vector<double>& cross_couplings);

/// Q0 [N/m] >= 0; 0 if a mode does not decay as it is, nothing if no cross-coupling up to 1e6 times
/// the largest stiffness makes one grow.
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

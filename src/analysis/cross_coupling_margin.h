// Stability margin against destabilizing cross-coupled stiffness (API 617 and API RP 684, level I):
// kxy = +Q, kyx = -Q [N/m] at one station, as of seals and impellers, and the logarithmic decrement
// over Q of the least damped forward mode there. (Where the bearings, not gyroscopic moments,
// define the planes of the modes: of those that do not whirl backward.) Q0, the margin, is the
// smallest Q at which a mode ceases to decay. Modes are classified at each Q separately: between
// unequal bearings one that is forward without Q may be backward with it, and a different one
// forward. Only whirl modes count (isWhirl).
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "analysis/whirl_modes.h"
#include "mechanics/dynamics.h"
#include "mechanics/linear_rotor.h"

namespace whirl_twin {

// Estimated cross-coupled stiffness of the working fluid of a stage (J. Alford, J. Engineering for
// Power 87, 1965; in API 617 for level I, modified by J. Wachel and W. von Nimitz, J. Petroleum
// Technology 33, 1981):
//
//   q = B (P / w) / (D H) * ratio
//
// P the power of the stage, w the speed, D the diameter of its impeller (an axial stage: at the
// blades' pitch), H the smallest width of its discharge, at the impeller or the diffuser (axial:
// the blades' height). A centrifugal stage has B = 3 and the ratio of the densities at discharge
// and suction; an axial one B = 1.5 and no ratio.

struct Stage {
  double power = 0.0;          ///< P [W]
  double diameter = 0.0;       ///< D [m]
  double width = 0.0;          ///< H [m]
  double density_ratio = 1.0;  ///< [-]
  bool axial = false;
};

/// q [N/m] at a speed > 0 [rad/s].
inline double alfordCrossCoupling(const Stage& stage, double speed) {
  const double torque = stage.power / speed;
  return stage.axial ? 1.5 * torque / (stage.diameter * stage.width)
                     : 3.0 * torque / (stage.diameter * stage.width) * stage.density_ratio;
}

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

/// Q0 [N/m] >= 0; 0 if a mode does not decay without it, nothing if no cross-coupling up to 1e6
/// times the largest stiffness makes one grow.
std::optional<double> crossCouplingMargin(const LinearRotor& rotor,
                                          const std::vector<Station>& stations, std::size_t station,
                                          double speed);

/// At the published station of a system.
struct CrossCouplingMargin {
  std::string station;
  std::optional<double> stiffness;  ///< Q0 [N/m]; none makes it grow
};

/// At a shaft speed [rad/s]. Nothing for a model that is not a linear rotor, or has more than
/// kMaxCoupledCoordinates: each of some fifty steps towards the margin costs all its eigenvalues.
constexpr int kMaxCoupledCoordinates = 64;
std::optional<CrossCouplingMargin> crossCouplingMarginOf(const Dynamics& dynamics, double speed);

}  // namespace whirl_twin

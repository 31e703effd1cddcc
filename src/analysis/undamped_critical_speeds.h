// Undamped critical speeds: the speeds w at which the rotor without its damping whirls as fast as
// it turns, forward or backward,
//
//   (K(w) - w^2 M + i w G(w)) phi = 0
//
// (API RP 684, 2.3; Friswell et al., Dynamics of Rotating Machines, 2010, 5.9). With mu the
// eigenvalues of (M - i G(w)/w) phi = mu K(w) phi, all real and continuous in w, they are the roots
// of w^2 mu(w) = 1: of constant bearings 1/sqrt(mu).
#pragma once

#include <vector>

#include "analysis/orbit.h"
#include "mechanics/linear_rotor.h"
#include "mechanics/rotors/rotor_assembly.h"

namespace whirl_twin {

// Critical speed map: the undamped forward critical speeds of a flexible rotor over the stiffness k
// of its bearings, on rigid ground, isotropic and undamped (API RP 684, 2.3; J. Vance,
// Rotordynamics of Turbomachinery, 1988). Where k is small the rotor moves as a rigid body on
// springs, w ~ sqrt(k); where it is large it bends between pins and w no longer depends on k.
//
// A round rotor on such bearings whirls in circles: with y = -i x and alpha = i beta forward whirl
// needs one plane only, and at w equal to the speed
//
//   (K + k P - w^2 (M - G1)) u = 0,   u = (x, beta) of every node,
//
// with G1 the gyroscopic moments per unit of speed: half as many coordinates, real, symmetric.

struct CriticalSpeedMap {
  std::vector<double> stiffness;            ///< k [N/m], of each bearing, ascending
  std::vector<std::vector<double>> speeds;  ///< [rad/s], of each mode over k, the lowest first
  std::vector<double> rigid;                ///< [rad/s], of each mode on bearings that do not yield
};

/// Of the `modes` lowest, or as many as there are, `points` >= 2 stiffnesses from `from` to `to`
/// [N/m] in equal ratios, at the nodes `supports`. Bearings of the shaft itself, pedestals and
/// damping are neglected. Throws InputError for fewer than two supports; RunFailure for a shaft
/// that buckles.
CriticalSpeedMap criticalSpeedMap(const FlexibleShaft& shaft, const std::vector<int>& supports,
                                  double from, double to, int points, std::size_t modes);

struct UndampedCriticalSpeed {
  double speed = 0.0;  ///< [rad/s]
  Whirl whirl = Whirl::kForward;
  std::vector<Orbit> orbits;  ///< [-], at each station; the widest has the semi-major axis 1
};

/// Ascending, up to `highest` [rad/s]. A motion without stiffness has none. Throws
/// RunFailure for a stiffness that is negative for some motion.
std::vector<UndampedCriticalSpeed> undampedCriticalSpeeds(const LinearRotor& rotor,
                                                          const std::vector<Station>& stations,
                                                          double highest);

}  // namespace whirl_twin

// Undamped critical speeds: the speeds w at which the rotor without its damping whirls as fast as
// it turns, forward or backward,
//
//   (K(w) - w^2 M + i w G(w)) phi = 0,
//
// and their map over the stiffness of the bearings (API RP 684, 2.3; Friswell et al., Dynamics of
// Rotating Machines, 2010, 5.9). With mu the eigenvalues of (M - i G(w)/w) phi = mu K(w) phi, all
// real and continuous in w, they are the roots of w^2 mu(w) = 1: of constant bearings 1/sqrt(mu).
#pragma once

#include <functional>
#include <vector>

#include "analysis/orbit.h"
#include "mechanics/linear_rotor.h"

namespace whirl_twin {

struct UndampedCriticalSpeed {
  double speed = 0.0;  ///< [rad/s]
  Whirl whirl = Whirl::kForward;
  std::vector<Orbit> orbits;  ///< [-], at each station; the widest has the semi-major axis 1
};

/// Ascending, up to `highest` [rad/s]. A motion without stiffness has none. Throws
/// std::domain_error for a stiffness that is negative for some motion.
std::vector<UndampedCriticalSpeed> undampedCriticalSpeeds(const LinearRotor& rotor,
                                                          const std::vector<Station>& stations,
                                                          double highest);

struct CriticalSpeedMapRow {
  double stiffness = 0.0;  ///< [N/m], of the bearings
  std::vector<UndampedCriticalSpeed> critical_speeds;
};

/// One row for each stiffness; `rotor` builds the rotor on bearings of a stiffness [N/m].
std::vector<CriticalSpeedMapRow> criticalSpeedMap(
    const std::function<LinearRotor(double stiffness)>& rotor, const std::vector<Station>& stations,
    const std::vector<double>& stiffnesses, double highest);

}  // namespace whirl_twin

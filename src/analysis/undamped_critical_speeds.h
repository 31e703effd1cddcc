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

namespace whirl_twin {

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

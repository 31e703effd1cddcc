// Shaft speeds at which a system becomes unstable, or stable again.
#pragma once

#include <Eigen/Core>
#include <optional>
#include <vector>

#include "mechanics/dynamics.h"

namespace whirl_twin {

/// The lowest speed [rad/s] above which the operating state is unstable, searched to 1000 times its
/// lowest natural frequency; nothing if there is none, or no shaft. A linear rotor is evaluated
/// from standstill; for any other model the equilibrium q is continued from `speed` [rad/s] up, or
/// down where it is unstable there (0: unstable at every lower speed too). Where the eigenvalues
/// are inconclusive, Routh's test decides, so the threshold is exact to rounding; beyond
/// kMaxExactCoordinates, or where exact numbers become too long, the eigenvalues alone do, to
/// about 1e-10 of it; for more than kMaxCompleteCoordinates the lowest modes, and all within the
/// bound of the unstable roots, where one is known (unstable_root_bound.h).
std::optional<double> instabilitySpeed(const Dynamics& dynamics, const Eigen::VectorXd& q,
                                       double speed);

/// A speed at which the verdict changes.
struct StabilityThreshold {
  double speed = 0.0;           ///< [rad/s]
  bool unstable_above = false;  ///< else below
};

/// All of them, ascending, as far as instabilitySpeed() searches, and likewise exact; 0 is one
/// where the system is unstable from standstill on. Of anything but a linear rotor the equilibrium
/// q is followed from `speed` [rad/s] down and up, as far as there is one.
std::vector<StabilityThreshold> stabilityThresholds(const Dynamics& dynamics,
                                                    const Eigen::VectorXd& q, double speed);

}  // namespace whirl_twin

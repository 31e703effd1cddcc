// The assumed modes method for a discrete system (lecture notes): q = [Phi] eta with r assumed
// shapes as columns reduces every matrix to [Phi]^T [.] [Phi] (m_ij = phi_i^T [m] phi_j, k_ij =
// phi_i^T [k] phi_j). The natural frequencies of the reduced system (Rayleigh-Ritz) are not below
// the exact ones of the same order; another shape never raises them; n independent ones give the
// exact ones.
#pragma once

#include <Eigen/Core>

#include "analysis/natural_modes.h"
#include "mechanics/dynamics.h"

namespace whirl_twin {

/// The system in r assumed shapes [n x r]; C, G and N are reduced like M and K. Throws
/// Refusal for shapes of the wrong size or linearly dependent ones (to 1e-10 of their
/// length).
Linearization reduced(const Linearization& system, const Eigen::MatrixXd& shapes);

struct RitzModes {
  Eigen::MatrixXd mass, stiffness;  ///< reduced [r x r]
  NaturalModes assumed;             ///< of the reduced system; shapes in eta [r x r]
  Eigen::MatrixXd shapes;           ///< the modes in q, mass-normalised [n x r]
};

/// Upper bounds of the r lowest natural frequencies, `assumed.frequencies` [rad/s]. Errors as
/// reduced() and naturalModes().
RitzModes ritzModes(const Eigen::MatrixXd& mass, const Eigen::MatrixXd& stiffness,
                    const Eigen::MatrixXd& shapes);

}  // namespace whirl_twin

// Steady response of a linear system to a harmonic force Re(F exp(i W t)): Re(X exp(i W t)) with
//   ([k] + [n] - W^2 [m] + i W ([c] + [g])) X = F,
// the inverse of the matrix being the receptance (influence coefficients of a vibration).
#pragma once

#include <Eigen/Core>

#include "mechanics/dynamics.h"

namespace whirl_twin {

/// Receptance [n x n] at W [rad/s], in the inverse of the units of the stiffness; entry ij is the
/// phasor of coordinate i under a unit force on j. Throws RunFailure, with the reason, where
/// there is no steady response: at an undamped resonance, and under a constant force on a
/// rigid-body mode (singular to 1e-13 as scaled to terms of size 1).
Eigen::MatrixXcd receptance(const Linearization& system, double frequency);

/// Phasors X [n] under the force phasors F [n] at W [rad/s]; their amplitudes are cwiseAbs(), their
/// lags behind the force -arg() [rad]. A solution of the equations even where the free motion
/// grows: it is then never reached. Errors as receptance().
Eigen::VectorXcd steadyResponse(const Linearization& system, const Eigen::VectorXcd& force,
                                double frequency);

}  // namespace whirl_twin

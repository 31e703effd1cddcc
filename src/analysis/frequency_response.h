// Steady response of a linear system to a harmonic force Re(F exp(i W t)): Re(X exp(i W t)) with
//   ([k] + [n] - W^2 [m] + i W ([c] + [g])) X = F,
// the inverse of the matrix being the receptance (influence coefficients of a vibration).
#pragma once

#include <Eigen/Core>
#include <vector>

#include "analysis/whirl_modes.h"
#include "mechanics/dynamics.h"
#include "mechanics/linear_rotor.h"

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

// Response of a linear rotor, its shaft at a constant speed w, to a harmonic force that does not
// turn with it, Re(e^(i W t)) at one place in one direction:
//
//   (K + N - W^2 M + i W (C + G)) X = a,   q = Re(X e^(i W t)).
//
// X at another place is a receptance [m/N], i W X a mobility [m/(N s)] (D. Ewins, Modal Testing,
// 2000). At rest, and without circulatory forces, a receptance stays what it is where force and
// place change parts.

struct ForcedResponse {
  double frequency = 0.0;     ///< W [rad/s]
  std::vector<Orbit> orbits;  ///< [m/N], at each station
};

/// At each of the frequencies [rad/s], the shaft at `speed` [rad/s], `direction` [dof] of the
/// force. Frequencies at which nothing limits the response, undamped resonances, are omitted.
std::vector<ForcedResponse> forcedResponse(const LinearRotor& rotor,
                                           const std::vector<Station>& stations, double speed,
                                           const Eigen::VectorXd& direction,
                                           const std::vector<double>& frequencies);

/// `points` >= 2 equally spaced from `from` to `to` [rad/s], and more around each of the modes.
std::vector<double> frequenciesAround(const std::vector<WhirlMode>& modes, double from, double to,
                                      int points);

// Influence coefficients (lecture notes, "stiffness and flexibility"): a_ij is the deflection of
// coordinate i under a unit force on coordinate j, {delta} = [a]{F}, [a] = [k]^-1.

/// [a] of a stiffness [n x n], in the inverse of its units (m/N between lengths), symmetric.
/// Throws RunFailure, with the reason in words, for a stiffness that carries no load at
/// rest: one with rigid-body modes, or negative for some motion; InputError for one that
/// is not symmetric.
Eigen::MatrixXd influenceCoefficients(const Eigen::MatrixXd& stiffness);

}  // namespace whirl_twin

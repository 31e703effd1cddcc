// Response of a linear rotor, its shaft at a constant speed w, to a harmonic force that does not
// turn with it, Re(e^(i W t)) at one place in one direction:
//
//   (K + N - W^2 M + i W (C + G)) X = a,   q = Re(X e^(i W t)).
//
// X at another place is a receptance [m/N], i W X a mobility [m/(N s)] (D. Ewins, Modal Testing,
// 2000). At rest, and without circulatory forces, a receptance stays what it is where force and
// place change parts.
#pragma once

#include <vector>

#include "analysis/whirl_modes.h"
#include "mechanics/linear_rotor.h"

namespace whirl_twin {

struct ForcedResponse {
  double frequency = 0.0;     ///< W [rad/s]
  std::vector<Orbit> orbits;  ///< [m/N], at each station
};

/// At each of the frequencies [rad/s], the shaft at `speed` [rad/s], `direction` [dof] of the
/// force. Frequencies at which nothing limits the response, undamped resonances, are left out.
std::vector<ForcedResponse> forcedResponse(const LinearRotor& rotor,
                                           const std::vector<Station>& stations, double speed,
                                           const Eigen::VectorXd& direction,
                                           const std::vector<double>& frequencies);

/// `points` >= 2 equally spaced from `from` to `to` [rad/s], and more around each of the modes.
std::vector<double> frequenciesAround(const std::vector<WhirlMode>& modes, double from, double to,
                                      int points);

}  // namespace whirl_twin

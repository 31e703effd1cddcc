// Critical speeds of a linear rotor: the speeds at which its synchronous unbalance response peaks.
//
//   (K + N - w^2 M + i w (C + G)) X = w^2 M (1, -i)        unit eccentricity at the disc
//
// Peak: the largest semi-major axis of the orbit, as a probe sees it. Amplification factor
// (API RP 684): AF = Nc / (N2 - N1), N1 and N2 where the response is 0.707 of the peak. For a
// Jeffcott rotor Nc = p / sqrt(1 - 2 zeta^2). Damping moves and widens a peak, and above zeta =
// 0.707 it is gone; so is the critical speed.
#pragma once

#include <string>
#include <vector>

#include "mechanics/dynamics.h"

namespace whirl_twin {

struct CriticalSpeed {
  double speed = 0.0;                 ///< [rad/s], of the peak
  double peak = 0.0;                  ///< [-], semi-major axis per eccentricity; inf undamped
  double lower = 0.0;                 ///< [rad/s], N1; NaN if the response does not fall to 0.707
  double upper = 0.0;                 ///< [rad/s], N2; NaN likewise
  double amplification_factor = 0.0;  ///< [-]; NaN where N1 or N2 is missing; inf undamped
  bool forward = true;                ///< the orbit at the peak runs with the rotation
};

/// Ascending. Empty for models that are not linear rotors.
std::vector<CriticalSpeed> criticalSpeeds(const Dynamics& dynamics);

/// The unbalance response at one speed [rad/s], per unit eccentricity.
struct UnbalanceResponse {
  double major = 0.0;   ///< [-], semi-major axis of the orbit
  double minor = 0.0;   ///< [-], semi-minor axis
  bool forward = true;  ///< direction of the orbit
  double slope = 0.0;   ///< [s/rad], d(major^2)/dw
};
UnbalanceResponse unbalanceResponse(const Dynamics& dynamics, double speed);

}  // namespace whirl_twin

// Critical speeds of a rotor: the speeds at which its synchronous unbalance response peaks.
//
//   (K + N - w^2 M + i w (C + G)) X = F(w)
//
// F is the rotor's own unbalance and bow; of a rotor without, w^2 M (a_x - i a_y): a unit
// eccentricity of the mass at the published station, x = a_x . q, y = a_y . q. Peak: the largest
// semi-major axis of the orbit there, as a probe sees it. Amplification factor (API RP 684):
// AF = Nc / (N2 - N1), N1 and N2 where the response is 0.707 of the peak. For a Jeffcott rotor
// Nc = p / sqrt(1 - 2 zeta^2). Damping moves and widens a peak, and above zeta = 0.707 it is gone;
// so is the critical speed. A mode that the unbalance does not excite, or that has its node at the
// station, makes no peak: undamped_critical_speeds.h has them all.
//
// Of a nonlinear rotor they are those of its small motion about where it hangs at each speed.
#pragma once

#include <vector>

#include "mechanics/dynamics.h"

namespace whirl_twin {

struct CriticalSpeed {
  double speed = 0.0;  ///< [rad/s], of the peak
  double peak = 0.0;   ///< semi-major axis: [m], or per unit eccentricity; inf undamped
  double lower = 0.0;  ///< [rad/s], N1; NaN if the response does not fall to 0.707
  double upper = 0.0;  ///< [rad/s], N2; NaN likewise
  double amplification_factor = 0.0;  ///< [-]; NaN where N1 or N2 is missing; inf undamped
  bool forward = true;                ///< the orbit at the peak runs with the rotation
};

struct CriticalSpeedSearch {
  std::vector<CriticalSpeed> found;  ///< ascending, up to the rotor's highest speed
  std::size_t beyond = 0;            ///< of a reduced rotor: how many more its equations would have
  double highest_speed = 0.0;        ///< [rad/s], validity limit of a reduced-order model; else
                                     ///< infinity
  /// [rad/s], the highest evaluated natural frequency at rest (Stability::omitted); else infinity.
  double searched_to = 0.0;
};

/// Empty for models that are not rotors on a shaft; of one whose spin is free it is the rotor with
/// its shaft held that has some (held_rotor.h).
CriticalSpeedSearch searchCriticalSpeeds(const Dynamics& dynamics);
/// Those found.
std::vector<CriticalSpeed> criticalSpeeds(const Dynamics& dynamics);

}  // namespace whirl_twin

// Steady speeds of an unbalanced rotor on a motor of limited torque (Sommerfeld 1902; Kononenko,
// Vibrating Systems with a Limited Power Supply, 1969): the motor's torque carries the drag and the
// power that the whirl takes from the shaft,
//
//   T(w) = d w + P(w) / w,   P = Re(conj(i w X) . F) / 2,
//
// X the response to the synchronous forces F. P is the power that non-rotating damping dissipates,
// less the power of circulatory forces. Near a resonance there are three speeds, or one from which
// a weak motor cannot escape.
#pragma once

#include <vector>

#include "control/motor.h"
#include "mechanics/linear_rotor.h"

namespace whirl_twin {

struct SteadySpeed {
  double speed = 0.0;   ///< [rad/s]
  double torque = 0.0;  ///< [N m], of the motor
  /// The load rises faster with the speed than the motor's torque. That is the quasi-static
  /// criterion: the whirl follows the speed at once.
  bool stable = true;
};

/// P / w [N m] at a speed [rad/s].
double whirlTorque(const LinearRotor& rotor, double speed);

/// Ascending, from above 0 to `highest` [rad/s].
std::vector<SteadySpeed> sommerfeldSpeeds(const LinearRotor& rotor, const Motor& motor,
                                          double highest);

/// Where the motor's torque comes down to its drag: the whirl only slows it further. [rad/s], 1e6
/// for a motor without a limit.
double highestSpeed(const Motor& motor);

}  // namespace whirl_twin

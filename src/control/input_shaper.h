// Input shaping: a command given in parts, so that what it sets swinging has come to rest when the
// last part is given (N. C. Singer, W. P. Seering, "Preshaping command inputs to reduce system
// vibration", J. Dynamic Systems, Measurement, and Control 112 (1990) 76). ZV, two parts half a
// period apart, leaves nothing of an oscillation it knows; ZVD, three, little of one near it.
#pragma once

#include <vector>

#include "control/input_signal.h"

namespace whirl_twin {

/// A part of a command, as a share of the whole, and how late it is given.
struct ShapedPart {
  double share;  ///< [-]; those of a shaper add up to 1
  double time;   ///< [s]
};

/// ZV, for an oscillation of a natural frequency [rad/s] > 0 and a damping ratio 0 <= zeta < 1.
std::vector<ShapedPart> zeroVibration(double frequency, double damping_ratio);

/// ZVD, likewise: flat in the frequency, a period long.
std::vector<ShapedPart> zeroVibrationDerivative(double frequency, double damping_ratio);

/// What is left of an oscillation after the last part, in parts of what the whole command at once
/// would have left by then.
double residualVibration(const std::vector<ShapedPart>& shaper, double frequency,
                         double damping_ratio);

/// A table in parts, at whole nanoseconds: again a table, of more instants.
InputSignal shaped(const InputSignal& table, const std::vector<ShapedPart>& shaper);

}  // namespace whirl_twin

// Input shaping: a command is divided into delayed parts that leave no residual vibration after the
// last part (N. C. Singer, W. P. Seering, "Preshaping command inputs to reduce system vibration",
// J. Dynamic Systems, Measurement, and Control 112 (1990) 76). ZV, two parts half a period apart,
// cancels an oscillation of exactly known frequency; ZVD, three parts, is robust against frequency
// errors.
#pragma once

#include <vector>

#include "control/input_signal.h"

namespace whirl_twin {

/// A part of a command, as a fraction of the whole, and its delay.
struct ShapedPart {
  double share;  ///< [-]; those of a shaper add up to 1
  double time;   ///< [s]
};

/// ZV, for an oscillation of a natural frequency [rad/s] > 0 and a damping ratio 0 <= zeta < 1.
std::vector<ShapedPart> zeroVibration(double frequency, double damping_ratio);

/// ZVD, likewise: flat in the frequency, a period long.
std::vector<ShapedPart> zeroVibrationDerivative(double frequency, double damping_ratio);

/// Residual oscillation after the last part, relative to that of the unshaped command at the same
/// time.
double residualVibration(const std::vector<ShapedPart>& shaper, double frequency,
                         double damping_ratio);

/// A table in parts, at whole nanoseconds: again a table, of more instants.
InputSignal shaped(const InputSignal& table, const std::vector<ShapedPart>& shaper);

}  // namespace whirl_twin

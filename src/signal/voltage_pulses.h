// Pulses of a keyphasor in the voltage of its pick-up.
//
// A pulse comes where the voltage passes the threshold in the direction of the slope, after it was
// beyond the threshold by the hysteresis on the other side; its instant is interpolated between two
// samples. The levels of a voltage suggest them: the threshold is half-way between
// them, the hysteresis a fifth of their distance, and the slope that of the way from the level that
// the voltage has for the longer time to the other.
#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "algebra/constants.h"

namespace whirl_twin {

/// Levels between which a voltage changes.
struct VoltageLevels {
  double low = 0.0, high = 0.0;  ///< [V]
  bool two = false;              ///< nearly all samples are near one of them
  bool mostly_high = false;      ///< most are nearer to the higher one
};
VoltageLevels levelsOf(std::vector<double> samples);

class VoltagePulses {
 public:
  VoltagePulses() = default;
  /// [V]
  VoltagePulses(double threshold, double hysteresis, bool falling)
      : threshold_(threshold), hysteresis_(hysteresis), falling_(falling) {}

  /// The next sample, at an instant [ns] later than the one before; the instant [ns] of a pulse
  /// between the two. NaN: no sample.
  std::optional<std::int64_t> take(std::int64_t instant, double volts);

 private:
  double threshold_ = 0.0, hysteresis_ = 0.0;
  bool falling_ = false, armed_ = false;
  double before_ = kNaN;  // V, beyond the threshold
  std::int64_t last_ = 0;
};

}  // namespace whirl_twin

// A keyphasor: a pulse each time a mark on the shaft passes the pick-up, forwards or backwards. It
// is the phase reference of a measurement.
#pragma once

#include <cstdint>
#include <vector>

#include "control/sensor.h"
#include "control/shaft_angle.h"

namespace whirl_twin {

struct KeyphasorSettings {
  double mark = 0.0;        ///< [rad], shaft angle at which a pulse comes
  double jitter = 0.0;      ///< [s], standard deviation of a pulse's instant
  double resolution = 0.0;  ///< [s], of the clock that stamps it; 0: whole nanoseconds
};

/// The shaft at an instant [ns].
struct ShaftInstant {
  std::int64_t time = 0;  ///< [ns]
  ShaftAngle angle;
  double speed = 0.0;  ///< [rad/s]
};

class Keyphasor {
 public:
  Keyphasor(const KeyphasorSettings& settings, std::uint32_t seed, std::uint32_t channel)
      : settings_(settings), noise_(seed, channel) {}

  /// Instants [ns] of the pulses in (from.time, to.time], in the order in which the mark passes.
  /// Between the two the angle is the cubic through angles and speeds; a shaft that turns round
  /// within a step may pass the mark twice unseen.
  std::vector<std::int64_t> pulses(const ShaftInstant& from, const ShaftInstant& to) const;

 private:
  KeyphasorSettings settings_;
  CounterNoise noise_;
};

}  // namespace whirl_twin

// The speeds at which a system loses its stability or finds it again, seen from the present speed:
// they stay the same whichever side of them it runs on. The sense of rotation does not matter.
#pragma once

#include <utility>
#include <vector>

#include "analysis/instability_speed.h"

namespace whirl_twin {

class ThresholdSpeeds {
 public:
  /// Of a system that has none.
  ThresholdSpeeds() = default;
  /// ascending: as stabilityThresholds() finds them.
  explicit ThresholdSpeeds(std::vector<StabilityThreshold> ascending)
      : thresholds_(std::move(ascending)) {}

  // [rad/s]; NaN: none.
  double lowest() const;             ///< above which it is unstable
  double below(double speed) const;  ///< the nearest but standstill
  double above(double speed) const;  ///< the nearest

  /// Whether one lies between two speeds [rad/s].
  bool between(double one, double other) const;
  /// Whether it is unstable at a speed [rad/s]; false without thresholds.
  bool unstableAt(double speed) const;

 private:
  std::vector<StabilityThreshold> thresholds_;
};

}  // namespace whirl_twin

// The speeds of a system that do not depend on the one it runs at: they follow from its parameters,
// and are found where its stability is evaluated.
#pragma once

#include <algorithm>
#include <utility>
#include <vector>

#include "algebra/constants.h"
#include "analysis/critical_speeds.h"
#include "analysis/instability_speed.h"
#include "analysis/separation_margin.h"
#include "messages/stability_margin.h"
#include "scene/built_system.h"

namespace whirl_twin {

/// The speeds at which a system loses its stability or finds it again, seen from the present speed:
/// they stay the same whichever side of them it runs on. The sense of rotation does not matter.
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
  template <class Is>
  double firstSpeed(const Is& is) const {
    const auto found = std::find_if(thresholds_.begin(), thresholds_.end(), is);
    return found == thresholds_.end() ? kNaN : found->speed;
  }

  std::vector<StabilityThreshold> thresholds_;
};

/// Where a rotor on its motor would be captured by a resonance (Sommerfeld's effect): the steady
/// speed below or in a critical band that only the whirl holds it at; without the resonance the
/// motor would take it beyond the band. By the quasi-static balance of torques
/// (sommerfeld_speeds.h): a motor with much of its power in the run-up itself may pass where that
/// predicts a capture.
struct CaptureSpeed {
  double speed = 0.0;           ///< [rad/s], of the capture
  double escape = 0.0;          ///< [rad/s], from which on it would pass by itself
  double critical_speed = 0.0;  ///< [rad/s], that captures it
  SpeedBand band;               ///< of that critical speed [rad/s]
};

struct CharacteristicSpeeds {
  std::vector<CriticalSpeed> critical;
  ThresholdSpeeds thresholds;
  /// Of a rotor on its motor, ascending; none where it passes every critical speed.
  std::vector<CaptureSpeed> captures;

  /// Those that follow from its parameters alone. Critical speeds beyond the tables of its bearings
  /// and pedestals are left out: the coefficients that cause them were not measured.
  static CharacteristicSpeeds of(const BuiltSystem& system);

  /// The critical speeds seen from a running speed [rad/s].
  std::vector<state::CriticalSpeedMargin> marginsAt(double speed) const;
};

}  // namespace whirl_twin

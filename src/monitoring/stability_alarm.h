// Stability of one system, from its Routh-Hurwitz margin.
//
// UNSTABLE: danger when a root lies in the right half-plane. Repeated imaginary roots are a warning
// of the same type: the motion may grow like a power of time, but the characteristic polynomial
// alone cannot tell that from two independent modes of one frequency (an isotropic rotor without
// damping), which stay bounded.
// LOW_DAMPING: a warning when the log decrement is below the setting (API 617 asks for 0.1), or the
// slowest decay below its own.
// ROUTH_DISAGREES: a warning when Routh's test and the eigenvalues count different numbers of roots
// in the right half-plane, and rounding does not explain it: then one of them, and the verdict, is
// wrong. An uncertain verdict near a threshold is no disagreement (rightByEigenvalues).
// UNSTABLE_WITHIN_SPREAD: a warning when more samples within a system's tolerances than the setting
// allows decay too slowly or grow, or the slowest decay found there is slower than its own limit.
// An uncertain verdict neither raises nor clears: a warning does not go away because the numbers
// can no longer be evaluated. But where a reduced-order rotor decays while its full-order model
// grows, or the other way, UNSTABLE is a warning; LOW_DAMPING goes by the full-order model.
#pragma once

#include <cmath>
#include <string>

#include "messages/stability_margin.h"
#include "monitoring/condition_alarm.h"

namespace whirl_twin {

/// The damping that LOW_DAMPING goes by, [1/s] and [-], of a margin of the twin or of ROS, which
/// have the same fields: where the rotor is reduced, that of its full-order model. Retained modes
/// have motions of high frequency besides that are none of the rotor's.
template <class Margin>
double dampingDecayRate(const Margin& margin) {
  return std::isnan(margin.unreduced_decay_rate) ? margin.decay_rate : margin.unreduced_decay_rate;
}
template <class Margin>
double dampingLogDecrement(const Margin& margin) {
  return std::isnan(margin.unreduced_decay_rate) ? margin.log_decrement
                                                 : margin.unreduced_log_decrement;
}

/// LOW_DAMPING is a criterion for rotors: of a system without a shaft no damping is required.
template <class Margin>
bool requiresDamping(const Margin& margin) {
  return std::isfinite(margin.speed);
}

class StabilityAlarm {
 public:
  /// damped: damping is required of the system, as of a rotor; a pendulum may swing as long as it
  /// likes.
  StabilityAlarm(const std::string& system, const SharedSettings& settings, bool damped = true);

  /// Evaluates one margin and updates the list. LOW_DAMPING is a rotor criterion: a system
  /// without a shaft (speed NaN) does not raise it, nor does a system that is unstable already.
  void update(const state::StabilityMargin& margin, AlertList& alerts);
  /// [1/s]: a slower decay is beyond the setting.
  double slowestDecay() const { return damped_ ? settings_->decay_rate_alarm : 0.0; }
  /// The input cannot be evaluated: delays are broken, and nothing is raised or cleared.
  void hold();

 private:
  double leastLogDecrement() const { return damped_ ? settings_->log_decrement_warning : 0.0; }
  void updateUnstable(const state::StabilityMargin& margin, AlertList& alerts);
  void updateLowDamping(const state::StabilityMargin& margin, AlertList& alerts);
  void updateDisagreement(const state::StabilityMargin& margin, AlertList& alerts);
  void updateSpread(const state::StabilityMargin& margin, AlertList& alerts);
  AlarmCondition dampingCondition(const state::StabilityMargin& margin) const;

  SharedSettings settings_;
  bool damped_;
  Alarm unstable_, low_damping_, disagreement_, spread_;
};

}  // namespace whirl_twin

// Stability of one system, from its Routh-Hurwitz margin.
//
// UNSTABLE: danger when a root lies in the right half-plane. Repeated imaginary roots are a warning
// of the same type: the motion may grow like a power of time, but the characteristic polynomial
// alone cannot tell that from two independent modes of one frequency (an isotropic rotor without
// damping), which stay bounded.
// LOW_DAMPING: a warning when the log decrement is below the setting (API 617 asks for 0.1), or the
// slowest decay below its own.
// ROUTH_DISAGREES: a warning when Routh's test and the eigenvalues count other roots in the right
// half-plane, and rounding does not explain it: then one of them, and the verdict, is wrong. An
// uncertain verdict near a threshold is no disagreement (rightByEigenvalues).
// UNSTABLE_WITHIN_SPREAD: a warning when more members of a system's spread than the setting says
// decay too slowly or grow, or the slowest decay found within the spread is slower than its own.
// An uncertain verdict neither raises nor clears: a warning does not go away because the numbers
// can no longer be judged. But of a rotor reduced to a few shapes, which decays while the rotor
// that they were taken from grows, or the other way, UNSTABLE is a warning; LOW_DAMPING goes by
// that rotor.
#pragma once

#include <cmath>
#include <string>

#include "messages/stability_margin.h"
#include "monitoring/alarm_settings.h"
#include "monitoring/alert_list.h"
#include "monitoring/condition_alarm.h"

namespace whirl_twin {

/// The damping that LOW_DAMPING goes by, [1/s] and [-], of a margin of the twin or of ROS, which
/// have the same fields: of the machine: where its rotor is reduced, of the one that it was reduced
/// from. Retained modes have motions of high frequency besides that are none of the rotor's.
template <class Margin>
double judgedDecayRate(const Margin& margin) {
  return std::isnan(margin.unreduced_decay_rate) ? margin.decay_rate : margin.unreduced_decay_rate;
}
template <class Margin>
double judgedLogDecrement(const Margin& margin) {
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
  StabilityAlarm(std::string system, const AlarmSettings& settings);

  /// Other settings from now on; what it knows of its cause, and for how long, stays.
  void set(const AlarmSettings& settings);
  /// Judges one margin and brings the list up to date. LOW_DAMPING is a rotor criterion: a system
  /// without a shaft (speed NaN) does not raise it, nor does a system that is unstable already.
  void update(const state::StabilityMargin& margin, AlertList& alerts);
  /// [1/s]: what decays slower is beyond the setting.
  double slowestDecay() const { return settings_.decay_rate_alarm; }
  /// What comes cannot be judged: delays are broken, and nothing is raised or cleared.
  void hold() {
    unstable_alarm_.hold();
    low_damping_alarm_.hold();
    disagreement_alarm_.hold();
    spread_alarm_.hold();
  }

 private:
  void updateUnstable(const state::StabilityMargin& margin, AlertList& alerts);
  void updateLowDamping(const state::StabilityMargin& margin, AlertList& alerts);
  void updateDisagreement(const state::StabilityMargin& margin, AlertList& alerts);
  void updateSpread(const state::StabilityMargin& margin, AlertList& alerts);
  AlarmCondition dampingCondition(const state::StabilityMargin& margin) const;
  state::Alert alertAbout(const state::StabilityMargin& margin) const;

  std::string system_;
  AlarmSettings settings_;
  ConditionAlarm unstable_alarm_;
  ConditionAlarm low_damping_alarm_;
  ConditionAlarm disagreement_alarm_;
  ConditionAlarm spread_alarm_;
};

}  // namespace whirl_twin

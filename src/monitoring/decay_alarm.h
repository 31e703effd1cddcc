// MODEL_MISMATCH: what a rotor's ambient vibration says of how fast it decays (signal/
// decay_audit.h) and what the model says of it are further apart than the interval of the former
// allows. Slow, and only where it is asked for (decay_audit: the length of the record). Nothing is
// said while the model is unstable: the vibration is then no small one about its steady motion.
#pragma once

#include <cstdint>
#include <string>

#include "messages/stability_margin.h"
#include "messages/states.h"
#include "monitoring/alarm_settings.h"
#include "monitoring/alert_list.h"
#include "monitoring/condition_alarm.h"
#include "signal/decay_audit.h"

namespace whirl_twin {

class DecayAlarm {
 public:
  DecayAlarm(std::string system, const AlarmSettings& settings);

  /// Other settings from now on; what it knows of its cause, and for how long, stays.
  void set(const AlarmSettings& settings);
  /// The next state; its parameters are those of the last margin.
  void update(const state::WhirlState& whirl, AlertList& alerts);
  void update(const state::StabilityMargin& margin);
  /// What comes cannot be judged, or the parameters are others: the record begins anew.
  void hold();
  bool active() const { return alarm_.active(); }

 private:
  void judge(const AuditedDecay& measured, double speed, AlertList& alerts);

  std::string system_;
  double record_;  // [s], that is judged; 0: none
  DecayAudit audit_;
  ConditionAlarm alarm_;
  double model_;             // [1/s]; NaN: nothing to compare with
  std::int64_t last_ = 0;    // step of the last state
  std::int64_t stride_ = 0;  // steps from state to state
  std::int64_t index_ = 0;   // of the last state, in strides
};

}  // namespace whirl_twin

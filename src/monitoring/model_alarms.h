// Alarms on a model that no longer describes its machine.
#pragma once

#include <cstdint>
#include <map>
#include <string>

#include "algebra/constants.h"
#include "messages/alert.h"
#include "messages/follow_state.h"
#include "messages/stability_margin.h"
#include "messages/states.h"
#include "monitoring/condition_alarm.h"
#include "signal/decay_audit.h"

namespace whirl_twin {

/// MODEL_MISMATCH: the decay rate measured in a rotor's ambient vibration (signal/decay_audit.h)
/// and that of the model are further apart than the interval of the former allows. Slow, and only
/// where it is asked for (decay_audit: the length of the record). Nothing is reported while the
/// model is unstable: the vibration is then no small one about its steady motion.
class DecayAlarm {
 public:
  DecayAlarm(const std::string& system, const SharedSettings& settings)
      : record_(settings->decay_audit),
        audit_(record_),
        alarm_(system, alert_type::kModelMismatch, settings) {}

  /// The next state; its parameters are those of the last margin.
  void update(const state::WhirlState& whirl, AlertList& alerts);
  void update(const state::StabilityMargin& margin);
  /// The input cannot be evaluated, or the parameters are different: the record restarts.
  void hold();
  bool active() const { return alarm_.active(); }

 private:
  void evaluate(const AuditedDecay& measured, double speed, AlertList& alerts);

  double record_;  // [s], that is evaluated; 0: none
  DecayAudit audit_;
  Alarm alarm_;
  double model_ = kNaN;      // [1/s]; NaN: nothing to compare with
  std::int64_t last_ = 0;    // step of the last state
  std::int64_t stride_ = 0;  // steps from state to state
  std::int64_t index_ = 0;   // of the last state, in strides
};

/// Alarms on what a state estimator knows of its machine (FollowState), each a warning:
///
///   MODEL_MISMATCH   the innovations are larger or smaller than the model allows, or correlated
///                    from sample to sample: beyond the limits in the message, which are those of
///                    a rate of false alarms (estimation/innovation_tests.h)
///   DRIFT            a parameter has changed (estimation/innovation_tests.h): which, from where,
///   to
///                    where, since when
///   SENSOR           a channel is silent, rejected or invalid, or the shaft's angle is unknown,
///                    for longer than sensor_delay; the machine's clock is off, or gains, by more
///                    than clock_offset or clock_drift
///
/// The audit of the decay raises MODEL_MISMATCH, too: while it does, its text has precedence.
class EstimatorAlarm {
 public:
  /// has_shaft: the motion of a shaft enters the system's, and has to be known.
  EstimatorAlarm(const std::string& system, bool has_shaft, const SharedSettings& settings)
      : has_shaft_(has_shaft),
        mismatch_(system, alert_type::kModelMismatch, settings),
        drift_(system, alert_type::kDrift, settings),
        sensor_(system, alert_type::kSensor, settings) {}

  /// mismatch_raised: another alarm has raised MODEL_MISMATCH.
  void update(const state::FollowState& follow, bool mismatch_raised, AlertList& alerts);

 private:
  void updateMismatch(const state::FollowState& follow, bool raised_by_other, AlertList& alerts);
  void updateDrift(const state::FollowState& follow, AlertList& alerts);
  void updateSensors(const state::FollowState& follow, AlertList& alerts);
  /// Present faults of sensors and clocks: of what, and which.
  std::map<std::string, std::string> faults(const state::FollowState& follow) const;

  bool has_shaft_;
  Alarm mismatch_, drift_, sensor_;
  std::map<std::string, double> fault_since_;  // [s]
};

}  // namespace whirl_twin

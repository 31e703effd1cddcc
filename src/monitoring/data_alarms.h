// Alarms on the data that the monitor evaluates: received at all, numerically valid, within the
// validity of the model.
#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "analysis/validity.h"
#include "integration/motion_state.h"
#include "messages/alert.h"
#include "monitoring/condition_alarm.h"

namespace whirl_twin {

/// DATA_LOST: a system has fallen silent while others continue, or all have without a pause.
///
/// The silence of one system is evaluated when a state of another source arrives, by wall time, so
/// that a paused simulation (all silent) is not mistaken for a lost system. When nothing at all
/// arrives and the simulation does not report a pause, nothing is monitored: that is one alert, of
/// the system "twin".
class DataLostAlarm {
 public:
  /// systems: those that are monitored, whether or not they were ever received.
  DataLostAlarm(const std::vector<std::string>& systems, const SharedSettings& settings);

  /// A state of source arrived at wall_time [s, a clock that only goes forward], valid at
  /// time [s, simulated]. A source that is not monitored (a drive) only shows that others continue.
  void received(const std::string& source, double wall_time, double time, AlertList& alerts);
  /// Time passes; paused: the simulation reports a pause.
  void tick(double wall_time, double time, bool paused, AlertList& alerts);

 private:
  struct System {
    Alarm alarm;
    double received_at;  ///< [s, wall]
  };
  void evaluate(System& system, double wall_time, double time, AlertList& alerts) const;

  SharedSettings settings_;
  std::vector<System> systems_;
  Alarm all_;
  double last_arrival_;   ///< [s, wall], of any source
  double flowing_since_;  ///< [s, wall], states have arrived without a common gap since then
};

/// LCM_LOST: the twin has messages that LCM cannot send (no multicast route, an interface gone), so
/// that every subscriber and log there has holes. A warning, of the system "twin".
class LcmLostAlarm {
 public:
  explicit LcmLostAlarm(const SharedSettings& settings)
      : alarm_(alert_type::kEverybody, alert_type::kLcmLost, settings, "") {}

  /// failed: messages that could not be sent since the simulation was started, as it reports at
  /// wall_time [s, a clock that only goes forward] and time [s, simulated]. The first number
  /// received is only what later ones are compared with: it may be of long ago.
  void update(double wall_time, double time, std::uint64_t failed, AlertList& alerts);

 private:
  Alarm alarm_;
  std::optional<std::uint64_t> before_;
};

/// Whether the states of one system are numerically valid.
///
/// ENERGY_RESIDUAL: a warning when the energy balance, change of energy against work and
/// dissipation, is off by more than the setting in two messages running: the step is too long for
/// the motion, or the model is wrong; of a system that `auto` steps, by more than its tolerance, if
/// that is larger: then it keeps what the scene asks. Two, for the residual is relative to the
/// largest energy so far, and after one step from rest there is next to none to compare with.
/// ACCURACY_LOST: a warning when the error that the twin estimates of its own steps is above what
/// the scene allows. NOT_FINITE: danger when the system was stopped because a state was no longer a
/// finite number. STOPPED: danger when it was stopped for another cause, an implicit step that did
/// not converge or a shaft at a speed that the step was not prepared for. They are two types, for
/// they ask for different actions: the first for another model or a check of its stability, the
/// second for a shorter step or a smaller speed.
class StateAlarm {
 public:
  StateAlarm(const std::string& system, const SharedSettings& settings)
      : energy_(system, alert_type::kEnergyResidual, settings),
        accuracy_(system, alert_type::kAccuracyLost, settings),
        stopped_(system, alert_type::kStopped, settings) {}

  /// residual [-] at time [s, simulated]; its sign does not matter. A NaN holds.
  void updateEnergy(double time, double residual, AlertList& alerts);
  /// estimate and tolerance [-] of the error over the horizon, at time [s, simulated]. A NaN holds.
  void updateAccuracy(double time, double estimate, double tolerance, AlertList& alerts);
  /// status: what the system reports at time [s, simulated]; text: its own sentence of why it
  /// stopped, which names the system. Clears clear_delay after the system runs again.
  void updateStopped(double time, StepStatus status, const std::string& text, AlertList& alerts);
  void holdEnergy() { energy_.hold(); }

 private:
  bool energy_above_ = false;
  double tolerance_ = 0.0;  // [-], of the error over the horizon, as last reported
  Alarm energy_, accuracy_, stopped_;
  const char* stopped_type_ = nullptr;  // of the alert that is raised
};

/// MODEL_INVALID: a warning while the equations of a system do not describe its machine: contact
/// lost, a rod's end reached, slipping, tipping, a mass matrix near singular.
class ValidityAlarm {
 public:
  ValidityAlarm(const std::string& system, std::shared_ptr<const Dynamics> dynamics,
                const SharedSettings& settings)
      : alarm_(system, alert_type::kModelInvalid, settings) {
    setDynamics(std::move(dynamics));
  }

  /// The parameters of the system have changed.
  void setDynamics(std::shared_ptr<const Dynamics> dynamics);
  /// The state at at.time [s, simulated].
  void update(const Eigen::VectorXd& q, const Eigen::VectorXd& v, const EvaluationPoint<double>& at,
              AlertList& alerts);
  void hold() { alarm_.hold(); }

 private:
  std::shared_ptr<const Dynamics> dynamics_;
  bool has_conditions_ = false;
  Alarm alarm_;
};

}  // namespace whirl_twin

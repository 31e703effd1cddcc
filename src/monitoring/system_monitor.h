// What the monitor keeps of one system: what it is, how it was last evaluated, and its alarms.
#pragma once

#include <Eigen/Core>
#include <cstddef>
#include <optional>
#include <string>
#include <vector>

#include "algebra/constants.h"
#include "messages/states.h"
#include "monitoring/characteristic_speeds.h"
#include "monitoring/data_alarms.h"
#include "monitoring/measured_signal.h"
#include "monitoring/model_alarms.h"
#include "monitoring/resonance_alarms.h"
#include "monitoring/stability_alarm.h"
#include "monitoring/vibration_alarms.h"
#include "scene/built_scene.h"

namespace whirl_twin {

/// [s], simulated, that verdicts on a speed that changes are apart: 10 ms of a linear rotor of up
/// to four coordinates, as the cube of their number beyond, and half the grid at least where the
/// steady motion has to be searched for.
double newsBreak(const Dynamics& dynamics);

/// All alarms of one system.
struct SystemAlarms {
  SystemAlarms(const BuiltSystem& system, const SharedSettings& settings);

  /// The input cannot be evaluated: no alarm clears by it, or counts it as time without its cause.
  void hold();
  /// Likewise of what is measured only: alarms on the motion.
  void holdMotion();

  StartUpNotice start_up;
  AmplitudeAlarm amplitude;
  VotedAlarm voted;
  OrderAlarm order;
  DecayAlarm decay;
  EstimatorAlarm estimator;
  CriticalSpeedAlarm critical_speed;
  CaptureAlarm capture;
  StabilityAlarm stability;
  StateAlarm state;
  ValidityAlarm validity;
};

struct SystemMonitor {
  SystemMonitor(SharedSystem system, CharacteristicSpeeds speeds, const SharedSettings& settings);
  /// The settings have changed; what the alarms know stays.
  void update(const AlarmSettings& settings);
  /// Time restarts: so do the alarms.
  void restart(const SharedSettings& settings);
  /// Alarms on the motion act on what is measured, not on the twin's states.
  bool isMeasured() const { return measured && measured->received(); }
  /// All coordinates of a rotor (or rates) as far as its whirl determines them: the smallest that
  /// give x and y at the station, and what the shaft has turned.
  std::vector<double> coordinates(double x, double y, double turned) const;
  /// The shaft of one whose spin is a coordinate in its state; its acceleration is the mean over
  /// some hundredths of a second.
  state::DriveState shaftOf(const state::PendulumState& state);

  std::string name;
  CharacteristicSpeeds speeds;  ///< as last evaluated
  bool rotor;
  std::size_t dof;
  Station station = {};       ///< of a rotor: where its whirl is measured
  Eigen::Index spin = -1;     ///< of one whose spin is free: the coordinate of its shaft
  std::string drive;          ///< "" at a constant speed of its own
  double speed;               ///< [rad/s], newest
  double acceleration = 0.0;  ///< [rad/s^2], newest
  std::optional<state::DriveState> seen;  ///< its shaft, of one without a drive
  DataQuality quality;
  std::optional<MeasuredSignal> measured;  ///< where the scene has sensors for it
  WhirlVibration vibration;
  SystemAlarms alarms;
  SharedSystem system;  ///< with its parameters as they are now
  /// What came last.
  struct Last {
    state::Instant at;
    std::vector<double> q, v;
    double arrived_at = 0.0;  ///< [s], wall time
  } last;
  bool evaluated = false;        ///< or requested
  double evaluated_at = 0.0;     ///< [s], simulated
  double evaluated_speed = 0.0;  ///< [rad/s]
  double news_break;             ///< [s], simulated, between verdicts before their turn
  double news_at = -kInfinity;   ///< [s], simulated, of the last
  double verdict_of = kNaN;      ///< [s], wall time of the state of the newest verdict
  std::string refused;           ///< why the parameters that were reported are invalid; "": valid
  std::string failure;           ///< why its last evaluation failed; "": it did not
  bool speeds_known = true;      ///< those of its parameters as they are

  /// Its critical speeds and captures can be evaluated.
  bool knowsSpeeds() const { return refused.empty() && speeds_known; }
  /// Why its verdict is uncertain, where it could not be evaluated; "": it could.
  const std::string& uncertainty() const { return refused.empty() ? failure : refused; }
};

}  // namespace whirl_twin

// What the monitor keeps of one system: what it is, how it was last judged, and its alarms.
#pragma once

#include <Eigen/Core>
#include <cstddef>
#include <limits>
#include <optional>
#include <string>
#include <vector>

#include "messages/states.h"
#include "monitoring/alarm_settings.h"
#include "monitoring/amplitude_alarm.h"
#include "monitoring/capture_alarm.h"
#include "monitoring/critical_speed_alarm.h"
#include "monitoring/data_quality.h"
#include "monitoring/decay_alarm.h"
#include "monitoring/following_alarm.h"
#include "monitoring/judged_speeds.h"
#include "monitoring/measured_signal.h"
#include "monitoring/order_alarm.h"
#include "monitoring/stability_alarm.h"
#include "monitoring/start_up.h"
#include "monitoring/state_alarm.h"
#include "monitoring/validity_alarm.h"
#include "monitoring/voted_alarm.h"
#include "monitoring/whirl_vibration.h"
#include "scene/built_scene.h"

namespace whirl_twin {

/// [s], simulated, that verdicts on a speed that changes are apart: 10 ms of a linear rotor of up
/// to four coordinates, as the cube of their number beyond, and half the grid at least where the
/// steady motion has to be looked for.
double newsBreak(const Dynamics& dynamics);

struct SystemWatch {
  SystemWatch(SharedSystem system, JudgedSpeeds speeds, const AlarmSettings& settings);
  /// Other settings from now on; what the alarms know stays.
  void set(const AlarmSettings& settings);
  /// Time begins anew: so do the alarms.
  void restart(const AlarmSettings& settings);
  /// What comes cannot be judged: no alarm clears by it, or counts it as time without its cause.
  void hold();
  /// Likewise of what is measured only: alarms on the motion.
  void holdMotion();
  /// Alarms on the motion act on what is measured, not on what the twin says.
  bool isMeasured() const { return measured && measured->heard(); }
  /// All coordinates of a rotor (or rates) as far as its whirl tells them: the smallest that give
  /// x and y at the station, and what the shaft has turned.
  std::vector<double> coordinates(double x, double y, double turned) const;
  /// The shaft of one whose spin is a coordinate that it tells; its acceleration is the mean over
  /// some hundredths of a second.
  state::DriveState shaftOf(const state::PendulumState& state);

  std::string name;
  JudgedSpeeds speeds;  ///< as last judged
  bool rotor;
  std::size_t dof;
  Station station = {};    ///< of a rotor: where its whirl is seen
  Eigen::Index spin = -1;  ///< of one whose spin is free: the coordinate of its shaft
  std::string drive;       ///< "" at a constant speed of its own
  double speed;            ///< [rad/s], newest
  std::optional<state::DriveState> seen;  ///< its shaft, of one without a drive
  double acceleration = 0.0;              ///< [rad/s^2], newest
  DataQuality quality;
  std::optional<MeasuredSignal> measured;  ///< where the scene has sensors for it
  WhirlVibration vibration;
  AmplitudeAlarm amplitude_alarm;
  VotedAlarm voted_alarm;
  StartUp start_up;
  bool has_levels;  ///< that a start-up multiplies
  OrderAlarm order_alarm;
  DecayAlarm decay_alarm;
  FollowingAlarm following_alarm;
  CriticalSpeedAlarm critical_speed_alarm;
  CaptureAlarm capture_alarm;
  StabilityAlarm stability_alarm;
  StateAlarm state_alarm;
  ValidityAlarm validity_alarm;
  SharedSystem system;  ///< with its parameters as they are now
  /// What came last.
  struct Last {
    state::Instant at;
    std::vector<double> q, v;
    double arrived_at = 0.0;  ///< [s], wall time
  } last;
  bool judged = false;        ///< or asked to be
  double judged_at = 0.0;     ///< [s], simulated
  double judged_speed = 0.0;  ///< [rad/s]
  double news_break;          ///< [s], simulated, between verdicts before their turn
  double news_at = -std::numeric_limits<double>::infinity();     ///< [s], simulated, of the last
  double verdict_of = std::numeric_limits<double>::quiet_NaN();  ///< [s], that of the verdict
  std::string refused;       ///< why the parameters that were reported cannot be its; "": they are
  std::string failure;       ///< why its last evaluation failed; "": it did not
  bool speeds_known = true;  ///< those of its parameters as they are

  /// Its critical speeds and captures can be judged.
  bool knowsSpeeds() const { return refused.empty() && speeds_known; }
  /// Why its verdict is uncertain, where it could not be evaluated; "": it could.
  const std::string& uncertainty() const { return refused.empty() ? failure : refused; }
};

}  // namespace whirl_twin

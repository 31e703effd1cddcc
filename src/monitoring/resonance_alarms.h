// Alarms on the resonances that the shaft of one rotor approaches, passes or is captured by.
#pragma once

#include <cstddef>
#include <deque>
#include <optional>
#include <string>
#include <vector>

#include "messages/alert.h"
#include "messages/states.h"
#include "monitoring/characteristic_speeds.h"
#include "monitoring/condition_alarm.h"

namespace whirl_twin {

/// Critical speeds of one rotor: a warning before a critical band is entered, one while the rotor
/// passes through it, danger when it dwells there.
///
/// The entry is predicted at constant acceleration: time = distance to the nearer edge of the band
/// / acceleration toward it; and only when the present move of the drive reaches the band. A
/// run-up, a run-down and negative rotation are alike: the band mirrored at zero is monitored as
/// well.
///
/// A shaft that stays in a band longer than the dwell limit is in danger, unless it passes: its
/// present acceleration takes it out before it has been there twice as long (for bands that
/// overlap, once more for each), its target lies beyond, and it has indeed moved so: what it has
/// gained over two thirds of that limit would take it out in time as well. So a ripple of the speed
/// makes no passage of a dwell, and no dwell of a passage: its slow half may last half the dwell
/// limit.
class CriticalSpeedAlarm {
 public:
  CriticalSpeedAlarm(const std::string& system, const SharedSettings& settings)
      : settings_(settings),
        band_alarm_(system, alert_type::kInCriticalBand, settings),
        approach_alarm_(system, alert_type::kCriticalSpeedApproach, settings) {}

  /// Evaluates one instant and updates the list.
  ///
  /// CRITICAL_SPEED_APPROACH (warning): the present move enters a band within approach_time, or
  /// creeps toward it from within the hysteresis of its edge. It stays as long as the move still
  /// reaches the band, and goes at once when the band is entered, because IN_CRITICAL_BAND then
  /// takes over; it does not come back while the rotor is no further from the band than the
  /// hysteresis, or IN_CRITICAL_BAND is active for it. A list with one is published again a few
  /// times a second, for its countdown.
  /// IN_CRITICAL_BAND: a warning while passing, danger after dwell_limit; clears outside of the
  /// band widened by the hysteresis, after clear_delay. It stays while the speed turns back to the
  /// band. Either is raised at most once by a speed that ripples about an edge: see ConditionAlarm.
  ///
  /// shaft: at.time [s], speed and target_speed [rad/s], acceleration [rad/s^2]. A target_speed of
  /// NaN is unknown: the move is assumed to continue with its acceleration, to standstill at most.
  /// When the speed is not finite nothing is raised or cleared. critical_speeds: in an order that
  /// does not change from call to call; an empty band (critically damped) never alarms.
  void update(const state::DriveState& shaft,
              const std::vector<state::CriticalSpeedMargin>& critical_speeds, AlertList& alerts);
  /// The input cannot be evaluated: delays are broken, and nothing is raised or cleared.
  void hold() {
    band_alarm_.hold();
    approach_alarm_.hold();
  }

 private:
  struct Entry;
  /// A band of one sense of rotation.
  struct Place {
    std::size_t index = 0;  ///< of its critical speed
    bool reverse = false;   ///< rotation in the negative sense

    bool operator==(const Place& other) const {
      return index == other.index && reverse == other.reverse;
    }
  };
  using CriticalSpeeds = std::vector<state::CriticalSpeedMargin>;

  double widening(double edge) const;
  bool inOrNear(double speed, const state::CriticalSpeedMargin& critical) const;
  void updateBand(const state::DriveState& shaft, const CriticalSpeeds& critical_speeds,
                  AlertList& alerts);
  void updateApproach(const state::DriveState& shaft, const CriticalSpeeds& critical_speeds,
                      AlertList& alerts);
  /// How the present move enters a band from outside; nothing if it does not.
  std::optional<Entry> entryOf(const state::DriveState& shaft,
                               const state::CriticalSpeedMargin& critical, Place place) const;
  std::optional<Entry> nextEntry(const state::DriveState& shaft,
                                 const CriticalSpeeds& critical_speeds) const;
  bool turnsBack(const state::DriveState& shaft, const CriticalSpeeds& critical_speeds) const;
  /// Would this acceleration [rad/s^2] take it out of the bands that it is in, in time?
  bool leavesInTime(const state::DriveState& shaft, double acceleration,
                    const CriticalSpeeds& critical_speeds) const;
  bool passes(const state::DriveState& shaft, const CriticalSpeeds& critical_speeds);

  SharedSettings settings_;
  Alarm band_alarm_, approach_alarm_;
  bool passing_ = false;     ///< has entered a band and not yet left it by the hysteresis
  double entered_at_ = 0.0;  ///< [s], while passing_ or the band alarm is active
  struct Sample {
    double time;   ///< [s]
    double speed;  ///< [rad/s]
  };
  std::deque<Sample> trail_;  ///< since it entered, at most two thirds of the dwell limit
  double in_time_at_ = 0.0;   ///< [s], its acceleration then would have taken it out in time
  Place stay_;                ///< the band that it passes, or that it was in last
  Place approached_;          ///< which band the active approach is about
};

/// SOMMERFELD_CAPTURE: a motor whose torque is below what a resonance takes does not bring its
/// rotor through. A warning as long as the rotor is on its way there, danger when its speed stays
/// constant in or below the band: all that the motor gives then goes into the whirl.
class CaptureAlarm {
 public:
  CaptureAlarm(const std::string& system, const SharedSettings& settings)
      : alarm_(system, alert_type::kSommerfeldCapture, settings) {}

  /// shaft: at.time [s] and speed [rad/s]; one that is not finite neither raises nor clears.
  void update(const state::DriveState& shaft, const std::vector<CaptureSpeed>& captures,
              AlertList& alerts);
  void hold();

 private:
  bool isSteady(double time, double speed, double scale);

  Alarm alarm_;
  bool steady_ = false;
  double steady_since_ = 0.0;  ///< [s]
  double steady_at_ = 0.0;     ///< [rad/s]
};

}  // namespace whirl_twin

// Critical speeds of one rotor: a warning before a critical band is entered, one while the rotor
// passes through it, danger when it dwells there.
//
// The entry is predicted at constant acceleration: time = distance to the nearer edge of the band /
// acceleration toward it; and only when the present move of the drive reaches the band. A run-up, a
// run-down and negative rotation are alike: the band mirrored at zero is watched as well.
//
// A shaft that stays in a band longer than the dwell limit is in danger, unless it passes: its
// present acceleration takes it out before it has been there twice as long (for bands that overlap,
// once more for each), its target lies beyond, and it has indeed moved like that: what it has
// gained over two thirds of that limit would take it out in time as well. So a ripple of the speed
// makes no passage of a dwell, and no dwell of a passage: its slow half may last half the dwell
// limit.
#pragma once

#include <cstddef>
#include <deque>
#include <optional>
#include <string>
#include <vector>

#include "messages/stability_margin.h"
#include "messages/states.h"
#include "monitoring/alarm_settings.h"
#include "monitoring/alert_list.h"
#include "monitoring/condition_alarm.h"

namespace whirl_twin {

class CriticalSpeedAlarm {
 public:
  CriticalSpeedAlarm(std::string system, const AlarmSettings& settings);

  /// Other settings from now on; what it knows of its cause, and for how long, stays.
  void set(const AlarmSettings& settings);
  /// Judges one instant and brings the list up to date.
  ///
  /// CRITICAL_SPEED_APPROACH (warning): the present move enters a band within approach_time, or
  /// creeps toward it from within the hysteresis of its edge. It stays as long as the move still
  /// reaches the band, and goes at once when the band is entered, because IN_CRITICAL_BAND then
  /// takes over; it does not come back while the rotor is no further from the band than the
  /// hysteresis, or IN_CRITICAL_BAND still stands for it. A list with one is published anew a few
  /// times a second, for its countdown.
  /// IN_CRITICAL_BAND: a warning while passing, danger after dwell_limit; clears outside of the
  /// band widened by the hysteresis, after clear_delay. It stays while the speed turns back to the
  /// band. Either is raised at most once by a speed that ripples about an edge: see ConditionAlarm.
  ///
  /// shaft: at.time [s], speed and target_speed [rad/s], acceleration [rad/s^2]. A target_speed of
  /// NaN is unknown: the move is taken to go on as it accelerates, to standstill at most. When the
  /// speed is not finite nothing is raised or cleared. critical_speeds: in an order that does not
  /// change from call to call; an empty band (critically damped) never alarms.
  void update(const state::DriveState& shaft,
              const std::vector<state::CriticalSpeedMargin>& critical_speeds, AlertList& alerts);
  /// What comes cannot be judged: delays are broken, and nothing is raised or cleared.
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
  state::Alert alertAbout(const state::DriveState& shaft,
                          const state::CriticalSpeedMargin& critical) const;

  std::string system_;
  AlarmSettings settings_;
  ConditionAlarm band_alarm_;
  ConditionAlarm approach_alarm_;
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

}  // namespace whirl_twin

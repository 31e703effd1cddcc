// Alarms on the amplitude of a rotor's whirl, as set for the speed of its shaft, whose levels a
// start-up multiplies.
#pragma once

#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "algebra/constants.h"
#include "messages/alert.h"
#include "messages/order_state.h"
#include "messages/states.h"
#include "monitoring/condition_alarm.h"
#include "monitoring/data_quality.h"
#include "monitoring/whirl_vibration.h"
#include "signal/whirl_component_class.h"

namespace whirl_twin {

/// Whether a shaft starts up, and amplitudes are allowed to be larger (trip multiply): it gains
/// speed, or did a moment ago. It gains speed where its acceleration and the mean of about half a
/// second of differences of its speed say so: the acceleration of an instant, from a keyphasor's
/// pulses, is mostly noise.
class StartUp {
 public:
  explicit StartUp(SharedSettings settings) : settings_(std::move(settings)) {}

  /// What levels are to be multiplied by [-] at time [s, simulated], with the speed [rad/s] and
  /// acceleration [rad/s^2] of the shaft.
  double multiplier(double time, double speed, double acceleration);

 private:
  SharedSettings settings_;
  double time_ = kNaN;             ///< [s], of the last call
  double speed_ = 0.0;             ///< [rad/s], likewise
  double mean_ = 0.0;              ///< [rad/s^2], of the gain of speed
  double begun_ = 0.0;             ///< [s], when it began to gain speed
  double gained_at_ = -kInfinity;  ///< [s], when it last gained speed
};

/// TRIP_MULTIPLIED: reports that a start-up multiplies levels that are set for a system.
class StartUpNotice {
 public:
  StartUpNotice(std::string system, const SharedSettings& settings)
      : system_(std::move(system)), settings_(settings), start_up_(settings) {}

  void update(const state::DriveState& shaft, AlertList& alerts);

 private:
  std::string system_;
  SharedSettings settings_;
  StartUp start_up_;
};

/// WHIRL_AMPLITUDE: the vibration of a rotor over a revolution (whirl_vibration.h) is above its
/// alert level (a warning) or its danger level. While the shaft starts up, and clear_delay after,
/// the levels are multiplied: the resonances it passes are expected, and the protection stays
/// active meanwhile.
class AmplitudeAlarm {
 public:
  AmplitudeAlarm(const std::string& system, const SharedSettings& settings)
      : start_up_(settings), alarm_(system, alert_type::kWhirlAmplitude, settings) {}

  /// amplitude [m] at time [s, simulated], with the speed [rad/s] and acceleration [rad/s^2] of the
  /// shaft. A NaN holds.
  void update(double time, double amplitude, double speed, double acceleration, AlertList& alerts);
  void hold() { alarm_.hold(); }

 private:
  StartUp start_up_;
  Alarm alarm_;
};

/// VOTED_AMPLITUDE: so many of a machine's sources of vibration (stations of a shaft, rotors that
/// are monitored side by side) whirl wider than the alert level (a warning) or the danger level,
/// 2 of 3 say. One sensor that lies raises nothing, and one that fails hides nothing:
///
///   danger, warning   at least `agree` sources are above that level
///   clear             even with the votes of those in doubt fewer than `agree` could be
///
/// In doubt are sources within the hysteresis, and those of bad quality (data_quality.h). They do
/// not vote, and the alert and MonitorStatus name them.
class VotedAlarm {
 public:
  VotedAlarm(const std::string& system, const SharedSettings& settings);

  /// The settings have changed; sources that stay keep their votes.
  void update();
  bool listensTo(const std::string& source) const;
  /// The whirl of a source came at wall_time [s]; acceleration [rad/s^2] of the shaft.
  void update(const state::WhirlState& whirl, double acceleration, double wall_time,
              AlertList& alerts);
  /// Wall time passes [s]: a silent source has no vote, and delays restart.
  void tick(double wall_time);
  /// Which sources do not vote, and why; "": all do. paused: the simulation reports a pause.
  std::string problem(double wall_time, bool paused) const;

 private:
  struct Source {
    std::string name;
    DataQuality quality;
    WhirlVibration vibration = {};
    double amplitude = 0.0;  ///< [m]
    bool votes = false;
  };
  struct Count {
    int danger = 0;
    int warning = 0;  ///< danger included
    int doubtful = 0;
  };
  Count count(double by) const;
  /// Writes text and numbers; `by`: what levels are multiplied by.
  void describe(const state::WhirlState& whirl, double by, bool danger, state::Alert& alert) const;

  std::optional<Voting> voting_;
  std::vector<Source> sources_;
  StartUp start_up_;
  Alarm alarm_;
};

/// Alarms on what the motion over some turns consists of (OrderState), each where its levels are
/// set:
///
///   VIBRATION_ZONE         peak-to-peak vibration in zone C (a warning) or D (danger), of the
///   zones
///                          that ISO 20816 has: new machines in A, unrestricted running in B,
///                          limited in C, damage in D. The levels are the machine's, and are
///                          multiplied while it starts up (StartUp).
///   SUBSYNCHRONOUS_WHIRL   a forward line slower than the shaft is higher than its level: oil
///                          whirl, which keeps its ratio to the speed, or whip, which keeps its
///                          frequency (signal/whirl_component_class.h)
///   RUB                    what whirls backward is wider than its level, or a line of a half or a
///                          third of the speed is: friction at the stator drives a shaft backward,
///                          and a contact once in two or three turns is seen at those. Danger where
///                          the motion as a whole has turned backward.
class OrderAlarm {
 public:
  OrderAlarm(const std::string& system, const SharedSettings& settings);

  /// acceleration [rad/s^2] of the shaft.
  void update(const state::OrderState& orders, double acceleration, AlertList& alerts);
  /// The input cannot be evaluated: delays are broken, and nothing is raised or cleared.
  void hold();

 private:
  void updateZone(const state::OrderState& orders, double acceleration, AlertList& alerts);
  void updateLine(const state::OrderState& orders, AlertList& alerts);
  void updateRub(const state::OrderState& orders, AlertList& alerts);

  StartUp start_up_;
  Alarm zone_alarm_, line_alarm_, rub_alarm_;
  WhirlComponentClass line_;
};

}  // namespace whirl_twin

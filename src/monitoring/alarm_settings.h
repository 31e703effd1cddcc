// The settings of the alarms: when to warn, when to raise danger, when to clear.
// The defaults are those of config/monitor.yaml.
#pragma once

#include <limits>
#include <map>
#include <memory>
#include <string>
#include <vector>

#include "signal/order_vector.h"

namespace whirl_twin {

/// Which alerts stay after their cause has gone, until the alarms are reset.
enum class Latch { kNone, kDanger, kAll };

/// Levels of a rotor's amplitude [m] (WhirlVibration) over the speed of its shaft, its sign left
/// out: linear between the points, and beyond them as at the last. Without points of speed, one
/// level for all.
struct AmplitudeLevels {
  std::vector<double> speed;   ///< [rad/s], rising
  std::vector<double> alert;   ///< [m], one a point; empty: none
  std::vector<double> danger;  ///< [m], likewise

  /// [m]: a wider whirl is no measurement (DataQuality).
  double range = std::numeric_limits<double>::infinity();

  /// Infinite where there is none.
  double alertAt(double shaft_speed) const { return levelAt(alert, shaft_speed); }
  double dangerAt(double shaft_speed) const { return levelAt(danger, shaft_speed); }

 private:
  double levelAt(const std::vector<double>& levels, double shaft_speed) const;
};

/// Levels of whirl radii [m], that so many of a machine's sources have to agree on.
struct Voting {
  std::vector<std::string> of;  ///< rotors and stations, by the names their whirl is published with
  int agree = 0;                ///< 1 to as many as there are
  // Infinite: none.
  double alert = std::numeric_limits<double>::infinity();
  double danger = std::numeric_limits<double>::infinity();
  double range = std::numeric_limits<double>::infinity();  ///< as AmplitudeLevels::range
};

/// Vibration [m], peak to peak, up to which a machine is in zone A, B or C of ISO 20816; D is
/// above.
struct VibrationZones {
  double a = 0.0, b = 0.0, c = 0.0;
};

/// Levels [m] of signs of a rub; infinite: none.
struct RubLevels {
  double backward = std::numeric_limits<double>::infinity();     ///< of what whirls backward
  double subharmonic = std::numeric_limits<double>::infinity();  ///< of a half and a third order
};

/// What turns with a shaft at any speed, its bow and the run-out of its surface: compensated in
/// measurements.
struct SlowRoll {
  double below = 0.0;  ///< [rad/s], it is learned while the shaft turns slower; 0: as given
  OrderVector given;   ///< of the first order
};

/// Of one type of alert [s]: how long its cause has to be there, and to have gone.
struct AlarmDelays {
  double set = 0.0;
  double clear = 1.0;
};

struct AlarmSettings {
  double approach_time = 2.0;          ///< [s], warn when a critical band will be entered within
  double clear_delay = 1.0;            ///< [s], an alert clears after this long without its cause
  double hysteresis = 0.02;            ///< [-], part of a limit to go back beyond before clearing
  double dwell_limit = 3.0;            ///< [s], in a critical band before it is danger
  double decay_rate_alarm = 0.0;       ///< [1/s], warn when decay is slower; 0: do not
  double log_decrement_warning = 0.1;  ///< [-], warn below (API 617 stability); 0: do not
  // Of the loops of controllers:
  double sensitivity_warning = 4.0;  ///< [-], warn above (ISO 14839-3: zone B ends); 0: do not
  double saturation_time = 10.0;     ///< [s], warn when saturated for longer; 0: do not
  // Of a system with a `spread` (tolerances) and no count:
  double members_beyond = 0.0;      ///< [-], warn when a larger part of its samples is beyond
  double lowest_decay_rate = 0.0;   ///< [1/s], warn when the slowest decay within it is slower
  double energy_residual = 1.0e-6;  ///< [-], warn when the energy balance is off by more
  double data_timeout = 1.0;        ///< [s] wall time, silence of one system among others
  Latch latch = Latch::kNone;
  std::map<std::string, AlarmDelays> delays;         ///< of types that have their own
  std::map<std::string, AmplitudeLevels> amplitude;  ///< of systems that have some
  std::map<std::string, Voting> voting;              ///< likewise
  std::map<std::string, VibrationZones> zones;       ///< likewise
  std::map<std::string, double> subsynchronous;  ///< [m], level of a whirl slower than the shaft
  std::map<std::string, SlowRoll> slow_roll;     ///< of systems that are measured
  std::map<std::string, RubLevels> rub;          ///< of systems that have some
  double decay_audit = 0.0;  ///< [s], record that decay is measured from; 0: it is not
  // Of a system with a state estimator:
  double sensor_delay = 2.0;    ///< [s], a channel or the shaft unknown this long is an alert
  double clock_offset = 1.0;    ///< [s], warn when the machine's clock is further off; 0: do not
  double clock_drift = 5.0e-4;  ///< [-], warn when it gains or loses more in a second; 0: do not
  double trip_multiply =
      1.0;  ///< [-], of the levels of amplitude and zones while a shaft starts up
  double start_up_acceleration = 0.5;  ///< [rad/s^2], it starts up when it gains speed faster
  /// [s], the most that an inhibition lasts (wall time), or a start-up's levels (simulated).
  double max_inhibition = 900.0;

  AlarmDelays delaysOf(const std::string& type) const;
};

/// Of one system; nullptr where it has none.
template <class Setting>
const Setting* settingOf(const std::map<std::string, Setting>& settings,
                         const std::string& system) {
  const auto own = settings.find(system);
  return own == settings.end() ? nullptr : &own->second;
}

/// The settings in force, shared by all alarms of a monitor: a change of them acts on what alarms
/// evaluate next, and what they know of their causes, and for how long, stays.
class SharedSettings {
 public:
  SharedSettings(const AlarmSettings& settings)  // implicit: an alarm alone has its own
      : settings_(std::make_shared<AlarmSettings>(settings)) {}

  const AlarmSettings& operator*() const { return *settings_; }
  const AlarmSettings* operator->() const { return settings_.get(); }
  /// For all that share them.
  void replace(const AlarmSettings& settings) { *settings_ = settings; }

 private:
  std::shared_ptr<AlarmSettings> settings_;
};

/// A number among the settings.
struct AlarmSetting {
  const char* key;
  double AlarmSettings::*value;
  bool (*isInRange)(double);
  const char* expected;  ///< "> 0 s", with its unit
};
const std::vector<AlarmSetting>& alarmSettings();

/// Keys of settings that have entries of their own, of types of alert and of rotors.
inline constexpr const char* kSettingMaps[] = {"delays",         "amplitude", "voting",   "zones",
                                               "subsynchronous", "rub",       "slow_roll"};

/// What is wrong with the numbers, one sentence a value ("clear_delay: must be >= 0 s, found -1");
/// empty when they can be used.
std::vector<std::string> settingErrors(const AlarmSettings& settings);

}  // namespace whirl_twin

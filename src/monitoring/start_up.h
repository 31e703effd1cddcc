// Whether a shaft starts up, and amplitudes are allowed to be larger (trip multiply): it gains
// speed, or did a moment ago. It gains speed where its acceleration and the mean of about half a
// second of differences of its speed say so: the acceleration of an instant, from a keyphasor's
// pulses, is mostly noise.
#pragma once

#include <cmath>
#include <limits>

#include "monitoring/alarm_settings.h"

namespace whirl_twin {

class StartUp {
 public:
  explicit StartUp(const AlarmSettings& settings) { set(settings); }

  /// Other settings from now on; a start-up goes on.
  void set(const AlarmSettings& settings) {
    multiply_ = settings.trip_multiply;
    acceleration_ = settings.start_up_acceleration;
    tail_ = settings.clear_delay;
    longest_ = settings.max_inhibition;
  }

  /// What levels are to be multiplied by [-] at time [s, simulated], with the speed [rad/s] and
  /// acceleration [rad/s^2] of the shaft.
  double multiplier(double time, double speed, double acceleration) {
    if (time < gained_at_) {  // time was set back
      gained_at_ = kNeverGained;
    }
    const double passed = time - time_;
    const double now =
        speed == 0.0 ? std::abs(acceleration) : std::copysign(1.0, speed) * acceleration;
    if (!(passed >= 0.0) || !std::isfinite(mean_)) {  // the first, or time was set back
      mean_ = now;
    } else if (passed > 0.0) {
      const double gained = (std::abs(speed) - std::abs(speed_)) / passed;
      mean_ += (gained - mean_) * -std::expm1(-passed / kMeanOver);
    }
    time_ = time;
    speed_ = speed;
    if (now > acceleration_ && mean_ > acceleration_) {
      begun_ = time - gained_at_ >= tail_ ? time : begun_;
      gained_at_ = time;
    }
    return time - gained_at_ < tail_ && time - begun_ < longest_ ? multiply_ : 1.0;
  }

 private:
  static constexpr double kNeverGained = -std::numeric_limits<double>::infinity();
  static constexpr double kMeanOver = 0.5;  // s

  double multiply_ = 1.0;
  double acceleration_ = 0.0;
  double tail_ = 0.0;     ///< [s], that the multiplied levels stay
  double longest_ = 0.0;  ///< [s], that one start-up multiplies levels
  double time_ = std::numeric_limits<double>::quiet_NaN();  ///< [s], of the last call
  double speed_ = 0.0;                                      ///< [rad/s], likewise
  double mean_ = 0.0;                                       ///< [rad/s^2], of the gain of speed
  double begun_ = 0.0;                                      ///< [s], when it began to gain speed
  double gained_at_ = kNeverGained;                         ///< [s], when it last gained speed
};

}  // namespace whirl_twin

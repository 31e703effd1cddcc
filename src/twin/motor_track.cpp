#include "twin/motor_track.h"

#include "mechanics/gradient.h"

namespace whirl_twin {

void MotorTrack::observe(const Motor& motor, double time, double speed, double acceleration,
                         double work) {
  const Gradient<double, 1> w(speed, 0);
  const Gradient<double, 1> power = motor.torque(w) * w;
  const double rate = power.slope[0] * acceleration;
  if (started_) {
    const double h = time - time_;
    work_ += h * (0.5 * (power_ + power.value) + h / 12.0 * (power_rate_ - rate));
  } else {
    started_ = true;
    first_ = work;
  }
  time_ = time;
  power_ = power.value;
  power_rate_ = rate;
  audited_ = work;
}

}  // namespace whirl_twin

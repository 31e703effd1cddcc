// The motion of a shaft over one step as a polynomial of time, without corners: what a step knows
// of a shaft that moves by itself. It answers where a Drive would be asked.
#pragma once

#include <limits>

#include "control/drive.h"

namespace whirl_twin {

struct ShaftCourse {
  double start = 0.0;  ///< [s], after begin() of the inputs: where the step starts
  double angle = 0.0;  ///< [rad], there, good for sin and cos
  double speed = 0.0;  ///< [rad/s]
  double acceleration = 0.0, jerk = 0.0, snap = 0.0;  ///< [rad/s^2], [rad/s^3], [rad/s^4]

  ShaftMotion at(double offset) const noexcept {
    const double t = offset - start;
    return {angle + t * (speed + t * (0.5 * acceleration +
                                      t * (jerk * (1.0 / 6.0) + t * (snap * (1.0 / 24.0))))),
            speed + t * (acceleration + t * (0.5 * jerk + t * (snap * (1.0 / 6.0)))),
            acceleration + t * (jerk + t * (0.5 * snap)), jerk + t * snap};
  }
  bool constantFor(double) const noexcept { return false; }
  double nextCorner(double) const noexcept { return std::numeric_limits<double>::infinity(); }
};

}  // namespace whirl_twin

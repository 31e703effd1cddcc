// e^(i theta) of a shaft at constant speed at the start of each of many equal steps: by one complex
// product a step, recomputed from the angle periodically and whenever the angle is not the
// predicted one.
//
// The rounding of a product is some 1e-16, as is that of the angle; between two recomputations the
// sum is some 5e-15.
#pragma once

#include <cmath>
#include <limits>

#include "control/drive.h"
#include "mechanics/sine_cosine.h"

namespace whirl_twin {

// The motion of a shaft with free spin over one step as a polynomial of time, without breakpoints.
// It has the interface of a Drive.

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

class ShaftPhasor {
 public:
  /// A step turns the shaft by `turn` [rad].
  void prepare(double turn) noexcept {
    turn_ = std::remainder(turn, kTwoPi);
    rotation_ = {std::sin(turn_), std::cos(turn_)};
    restart();
  }
  void restart() noexcept { steps_left_ = 0; }

  /// To the next step, whose angle [rad] is a remainder of whole turns.
  void turnTo(double angle) noexcept {
    double off = angle - angle_ - turn_;
    off = off > 0.5 * kTwoPi ? off - kTwoPi : off < -0.5 * kTwoPi ? off + kTwoPi : off;
    angle_ = angle;
    if (--steps_left_ < 0 || !(std::fabs(off) < kRounding)) {
      phasor_ = sineCosine(angle);
      steps_left_ = kSteps;
      return;
    }
    const double sine = phasor_.sine * rotation_.cosine + phasor_.cosine * rotation_.sine;
    const double cosine = phasor_.cosine * rotation_.cosine - phasor_.sine * rotation_.sine;
    phasor_ = {sine + off * cosine, cosine - off * sine};
  }
  double sine() const noexcept { return phasor_.sine; }
  double cosine() const noexcept { return phasor_.cosine; }

 private:
  static constexpr double kTwoPi = 6.283185307179586;
  static constexpr double kRounding = 1.0e-9;  ///< [rad]; its square is nothing
  static constexpr int kSteps = 16;

  double turn_ = 0.0;   ///< [rad], of a step
  double angle_ = 0.0;  ///< [rad], of phasor_
  int steps_left_ = 0;  ///< until it is recomputed
  SineCosine phasor_{0.0, 1.0};
  SineCosine rotation_{0.0, 1.0};
};

}  // namespace whirl_twin

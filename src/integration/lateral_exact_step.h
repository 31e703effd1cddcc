// The exact step of a rotor of two coordinates at constant speed.
//
// States y = (x, y, x', y'), the shaft's phasor (cos, sin) and 1 form one linear system with
// constant coefficients: the step is its matrix exponential, for any step, stiff or not, damped or
// not, at resonance or not (as in exponential.h),
//
//   dy = P y + f + s,   work = y . (W y + p + r) + h,
//
// the work a quadratic form, the integral of e^(A't) S e^(At). f and p turn with the shaft: f =
// f_c cos + f_s sin, and so do h and its parts of twice the angle. They are kept with their
// derivatives by the angle, which a step's angle turns into one another, so that what depends on
// the motion of the last step is four columns of four numbers each.
#pragma once

#include <array>
#include <cmath>
#include <limits>

#include "integration/four_doubles.h"
#include "integration/lateral_motion.h"
#include "integration/lateral_rotor.h"
#include "mechanics/force_inline.h"

namespace whirl_twin {

class LateralExactStep {
 public:
  LateralExactStep(const LateralRotor& rotor, double h) : rotor_(rotor), h_(h) {}

  // Real-time safe.

  /// The motion is set anew.
  void restart() noexcept { turns_left_ = 0; }

  /// Advances by h [s] over a step that starts where the last one ended: the shaft, a constant
  /// speed later, at an angle [rad] that is a remainder of whole turns. False, with nothing done,
  /// where it does not, and once in a while.
  template <int lanes>
  WHIRL_TWIN_INLINE bool goesOn(double angle, LateralMotion& motion, StepStatus& status) noexcept {
    double off = angle - angle_ - turn_;
    off = off > 0.5 * kTwoPi ? off - kTwoPi : off < -0.5 * kTwoPi ? off + kTwoPi : off;
    if (__builtin_expect(turns_left_ <= 0 || !(std::fabs(off) < kAngleRounding), 0)) {
      return false;
    }
    --turns_left_;
    angle_ = angle;
    turn<FourDoubles<lanes>>();
    status = take<FourDoubles<lanes>>(motion);
    return true;
  }
  /// Advances by h [s] at a speed [rad/s] that lasts, from anywhere. A new speed is prepared for
  /// first, which costs many times a step. Either leaves the motion as it was if the new one is
  /// not finite.
  StepStatus advance(double angle, double speed, LateralMotion& motion) noexcept;

 private:
  static constexpr double kTwoPi = 6.283185307179586;
  static constexpr double kAngleRounding = 4.0e-15;  ///< [rad]

  /// Four numbers each.
  struct Numbers {
    alignas(32) std::array<double, 4> all{};
  };
  /// What turns with the shaft: at angle 0, a quarter of a turn on, now, and its derivative by the
  /// angle now.
  struct Turning {
    Numbers ahead, aside, now, slope;
    void turnTo(double cosine, double sine) noexcept;
  };

  void prepare(double speed) noexcept;

  /// By a step's angle: products that round by some 1e-16.
  template <class Four>
  WHIRL_TWIN_INLINE void turn() noexcept {
    const Four c = Four::all(cosine_);
    const Four s = Four::all(sine_);
    const auto turned = [&](Turning & it) __attribute__((always_inline)) {
      const Four now = Four::load(it.now.all.data());
      const Four slope = Four::load(it.slope.all.data());
      (c * now + s * slope).store(it.now.all.data());
      (c * slope - s * now).store(it.slope.all.data());
    };
    turned(force_);
    turned(force_power_);
    if (turns_at_rest_) {
      turnAtRest(cosine_, sine_);
    }
  }
  WHIRL_TWIN_INLINE void turnAtRest(double cosine, double sine) noexcept {
    const std::array<double, 2> cosines{cosine, cosine * cosine - sine * sine};
    const std::array<double, 2> sines{sine, 2.0 * cosine * sine};
    at_rest_ = steady_at_rest_;
    for (std::size_t i = 0; i < 2; ++i) {
      double& now = turning_at_rest_.now.all[i];
      double& slope = turning_at_rest_.slope.all[i];
      const double before = now;
      now = cosines[i] * now + sines[i] * slope;
      slope = cosines[i] * slope - sines[i] * before;
      at_rest_ += now;
    }
  }

  template <class Four>
  WHIRL_TWIN_INLINE StepStatus take(LateralMotion& motion) noexcept {
    const auto numbers = [](const Numbers& n) __attribute__((always_inline)) {
      return Four::load(n.all.data());
    };
    // What hangs on the last step comes last.
    const Four a = Four::all(motion.y[0]);
    const Four b = Four::all(motion.y[1]);
    const Four c = Four::all(motion.y[2]);
    const Four d = Four::all(motion.y[3]);
    const Four y = Four::load(motion.y.data());
    const Four corrected =
        (numbers(moves_[0]) * a + (numbers(moves_[1]) * b + ((numbers(force_.now) + numbers(sag_)) +
                                                             Four::load(motion.low.data())))) +
        (numbers(moves_[2]) * c + numbers(moves_[3]) * d);
    const Four by_y =
        (numbers(powers_[0]) * a +
         (numbers(powers_[1]) * b + (numbers(force_power_.now) + numbers(sag_power_)))) +
        (numbers(powers_[2]) * c + numbers(powers_[3]) * d);
    // Compensated sums.
    const Four next = y + corrected;
    CompensatedSum work = motion.work;
    work.add((y * by_y + (next - next)).sum() + at_rest_);  // no number where one of them is none
    if (__builtin_expect(!(work.high - work.high == 0.0), 0)) {
      return StepStatus::kNotFinite;
    }
    (corrected - (next - y)).store(motion.low.data());
    next.store(motion.y.data());
    motion.work = work;
    return StepStatus::kOk;
  }

  double speed_ = std::numeric_limits<double>::quiet_NaN();  ///< [rad/s], prepared for
  double turn_ = 0.0, cosine_ = 1.0, sine_ = 0.0;            ///< a step's angle [rad]
  double angle_ = 0.0;                                       ///< [rad], turned to
  int turns_left_ = 0;                                       ///< until all is made anew
  bool turns_at_rest_ = false;
  double at_rest_ = 0.0;  ///< h [J]
  std::array<Numbers, 4> moves_, powers_;
  Turning force_, force_power_;
  Numbers sag_, sag_power_;
  double steady_at_rest_ = 0.0;
  Turning turning_at_rest_;  ///< of h: by the angle, by twice the angle, 0, 0

  LateralRotor rotor_;
  double h_;  ///< [s]
};

}  // namespace whirl_twin

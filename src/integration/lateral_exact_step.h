// The exact step of a rotor of two coordinates at constant speed.
//
// States, the shaft's phasor (cos, sin) and 1 form one linear system y' = A y with constant A:
// y1 = e^(A h) y0, for any step, stiff or not, damped or not, at resonance or not (as in
// exponential.h). The audited work is y0' W y0 with W = integral of e^(A't) S e^(At).
//
// An isotropic rotor takes its step in z = x + i y and w = z': with u = e^(i theta)
//
//   dz = P_zz z + P_zw w + F_z u + G_z,   dw = P_wz z + P_ww w + F_w u + G_w,
//   work = Re[z* (a z + b w + c u + d) + w* (e w + f u + g) + u* j] + constant,
//
// a Hermitian form. Both lines of each go side by side in a vector of four.
#pragma once

#include <Eigen/Core>
#include <array>
#include <cmath>
#include <complex>
#include <limits>

#include "integration/four_doubles.h"
#include "integration/lateral_motion.h"
#include "integration/lateral_rotor.h"
#include "mechanics/force_inline.h"
#include "mechanics/sine_cosine.h"

namespace whirl_twin {

class LateralExactStep {
 public:
  LateralExactStep(const LateralRotor& rotor, double h) : rotor_(rotor), h_(h) {}

  // Real-time safe.

  /// The motion is set anew.
  void restart() noexcept { turns_left_ = 0; }

  /// Advances by h [s] over a step that starts where the last one ended: the shaft, a constant
  /// speed later, at an angle [rad] that is a remainder of whole turns. False, with nothing done,
  /// where it does not, for a rotor that is not isotropic, and once in a while.
  template <int lanes>
  WHIRL_TWIN_INLINE bool goesOn(double angle, LateralMotion& motion, StepStatus& status) noexcept {
    double off = angle - angle_ - turn_;
    off = off > 0.5 * kTwoPi ? off - kTwoPi : off < -0.5 * kTwoPi ? off + kTwoPi : off;
    if (__builtin_expect(turns_left_ <= 0 || !(std::fabs(off) < kAngleRounding), 0)) {
      return false;
    }
    --turns_left_;
    angle_ = angle;
    turn<FourDoubles<lanes>>(off);
    status = whirl<FourDoubles<lanes>>(motion);
    return true;
  }
  /// Advances by h [s] at a speed [rad/s] that lasts, from anywhere. A new speed is prepared for
  /// first, which costs many times a step. Either leaves the motion as it was if the new one is
  /// not finite.
  StepStatus advance(double angle, double speed, LateralMotion& motion) noexcept;

 private:
  /// x, y and x', y' (over a frequency); cos, sin; 1.
  static constexpr int kAll = 7;
  using All = Eigen::Matrix<double, kAll, 1>;
  using Square = Eigen::Matrix<double, kAll, kAll>;
  using Increment = Eigen::Matrix<double, 4, kAll>;

  void prepare(double speed) noexcept;
  StepStatus general(const SineCosine& turn, LateralMotion& motion) noexcept;

  /// A complex factor for each line: its real part twice, its imaginary part with both signs.
  struct Factors {
    alignas(32) std::array<double, 4> real{}, imaginary{};
  };

  /// What turns with the shaft, by a step's angle and what that is off by: one product, which
  /// rounds by some 1e-16, and so does the angle it is for.
  template <class Four>
  WHIRL_TWIN_INLINE void turn(double off) noexcept {
    const Four all_off = Four::all(off);
    const Four real =
        Four::load(turning_.real.data()) + all_off * Four::load(turning_across_.real.data());
    const Four imaginary = Four::load(turning_.imaginary.data()) +
                           all_off * Four::load(turning_across_.imaginary.data());
    const auto turned = [&](std::array<double, 4> & numbers) __attribute__((always_inline)) {
      const Four before = Four::load(numbers.data());
      (before * real + before.across() * imaginary).store(numbers.data());
    };
    turned(forced_);
    turned(forced_power_);
    if (loaded_) {
      turned(loaded_power_);
    }
  }

  template <class Four>
  WHIRL_TWIN_INLINE StepStatus whirl(LateralMotion& motion) noexcept {
    const Four y = Four::load(motion.y.data());
    const Four z = Four::twice(motion.y.data());
    const Four w = Four::twice(motion.y.data() + 2);
    // What hangs on the last step comes last.
    Four corrected = Four::load(forced_.data()) + Four::load(motion.low.data());
    Four by_y = Four::load(forced_power_.data());
    double steady = constant_;
    if (loaded_) {
      corrected = corrected + Four::load(sag_.data());
      by_y = by_y + Four::load(sag_power_.data());
      steady += loaded_power_[0];
    }
    if (coupled_) {
      corrected = corrected + (Four::load(moves_[0].imaginary.data()) * z.across() +
                               Four::load(moves_[1].imaginary.data()) * w.across());
      by_y = by_y + (Four::load(powers_[0].imaginary.data()) * z.across() +
                     Four::load(powers_[1].imaginary.data()) * w.across());
    }
    corrected =
        Four::load(moves_[0].real.data()) * z + (Four::load(moves_[1].real.data()) * w + corrected);
    by_y = Four::load(powers_[0].real.data()) * z + (Four::load(powers_[1].real.data()) * w + by_y);
    // Compensated sums.
    const Four next = y + corrected;
    CompensatedSum work = motion.work;
    work.add((y * by_y + (next - next)).sum() + steady);  // no number where one of them is none
    if (__builtin_expect(!(work.high - work.high == 0.0), 0)) {
      return StepStatus::kNotFinite;
    }
    (corrected - (next - y)).store(motion.low.data());
    next.store(motion.y.data());
    motion.work = work;
    return StepStatus::kOk;
  }

  static constexpr double kTwoPi = 6.283185307179586;
  static constexpr double kAngleRounding = 1.0e-9;  ///< [rad]; its square is nothing

  double speed_ = std::numeric_limits<double>::quiet_NaN();  ///< [rad/s], prepared for
  double turn_ = 0.0;                                        ///< [rad], of a step
  double angle_ = 0.0;                                       ///< [rad], that phasor_ stands at
  int turns_left_ = 0;                                       ///< until it is made anew
  Factors turning_;                                          ///< by turn_
  Factors turning_across_;                                   ///< a quarter of a turn further
  // Of an isotropic rotor: by z and w, what turns (F_z, F_w; c, f; j), and the rest.
  bool coupled_ = false;
  bool loaded_ = false;
  std::array<Factors, 2> moves_, powers_;
  alignas(32) std::array<double, 4> forced_{}, forced_power_{}, loaded_power_{};
  alignas(32) std::array<double, 4> sag_{}, sag_power_{};
  double constant_ = 0.0;
  /// At a shaft's angle of 0.
  std::array<std::complex<double>, 2> force_, force_power_;
  std::complex<double> load_power_;

  LateralRotor rotor_;
  double h_;  ///< [s]
  // Of any.
  Increment increment_;
  Square work_;
};

}  // namespace whirl_twin

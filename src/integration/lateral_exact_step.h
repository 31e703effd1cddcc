// The exact step of a rotor of two coordinates at constant speed.
//
// States y = (x, y, x', y'), the shaft's phasor (cos, sin) and 1 form one linear system with
// constant coefficients: the step is its matrix exponential, for any step, stiff or not, damped or
// not, at resonance or not (as in exponential.h),
//
//   dy = P y + f + s,   work = y . (W y + p + r) + h,
//
// the work a quadratic form, the integral of e^(A't) S e^(At). f and p are synchronous, f = f_c cos
// + f_s sin, and h has 1X and 2X components: only four columns of four numbers each depend on the
// motion of the last step.
//
// cos and sin are rotated from step to step, by a rotation known to twice the digits of a double:
// far above the critical speed forces (w/p)^2 times as large as their sum accumulate, and a
// systematic error of the rotation would accumulate with them. A random rounding error of some
// 1e-16 per step remains; the phasor is periodically recomputed from the shaft's angle.
#pragma once

#include <array>
#include <cstdint>
#include <limits>
#include <optional>

#include "control/drive.h"
#include "integration/lateral_rotor.h"
#include "integration/simd_vector.h"
#include "mechanics/force_inline.h"

namespace whirl_twin {

class LateralExactStep {
 public:
  LateralExactStep(const LateralRotor& rotor, double h);

  // Real-time safe.

  /// Discards the history, after the motion has been set.
  void restart() noexcept { turns_left_ = 0; }

  /// The speed [rad/s] if the last step ended at the drive's begin() and the next may continue from
  /// it.
  std::optional<double> speedAt(const Drive& drive) const noexcept {
    if (turns_left_ <= 0 || drive.nanoseconds() != next_ || drive.piece() != piece_) {
      return std::nullopt;
    }
    return speed_;
  }

  /// Advances by h [s] over a step that starts where the last one ended, at the same speed. False,
  /// with nothing done, where it does not, and once in a while. A motion that would not be finite
  /// stays as it was.
  template <int lanes>
  WHIRL_TWIN_INLINE bool goesOn(const Drive& drive, LateralMotion& motion,
                                StepStatus& status) noexcept {
    if (__builtin_expect(
            turns_left_ <= 0 || drive.nanoseconds() != next_ || drive.piece() != piece_, 0)) {
      return false;
    }
    --turns_left_;
    status = take<FourDoubles<lanes>>(motion);
    return true;
  }
  /// Advances by h [s] from anywhere, at a speed that lasts so long. A new speed is prepared for
  /// first, which costs many times a step.
  StepStatus advance(const Drive& drive, LateralMotion& motion) noexcept;

 private:
  /// Four numbers each.
  struct Numbers {
    alignas(32) std::array<double, 4> all{};
  };
  /// Synchronous parts, at angle 0 and a quarter of a turn ahead, and the constant part.
  struct Turning {
    Numbers ahead, aside, rest;
  };
  /// Of x, y, x', y'; of x', y', x, y; of y, x, y', x'; of y', x', y, x.
  struct Columns {
    Numbers along, swapped, across, across_swapped;
  };
  /// A cosine and a sine, four times each.
  struct Phasor {
    Numbers cosine, sine;
    void set(double c, double s) noexcept {
      cosine.all.fill(c);
      sine.all.fill(s);
    }
  };

  void prepare(double speed) noexcept;

  template <class Four>
  WHIRL_TWIN_INLINE StepStatus take(LateralMotion& motion) noexcept {
    const auto numbers = [](const Numbers& n) __attribute__((always_inline)) {
      return Four::load(n.all.data());
    };
    const Four cosine = numbers(phasor_.cosine);
    const Four sine = numbers(phasor_.sine);
    const Four y = Four::load(motion.y.data());
    const Four swapped = y.halvesSwapped();
    const auto turned = [&](const Turning& it) __attribute__((always_inline)) {
      return (numbers(it.ahead) * cosine + numbers(it.aside) * sine) + numbers(it.rest);
    };
    // Terms that depend on the last step come last, and its compensations at the very end.
    Four move = turned(force_);
    Four by_y = turned(force_power_);
    if (coupled_) {
      const auto across = [&](const Columns& it) __attribute__((always_inline)) {
        return numbers(it.across) * y.across() + numbers(it.across_swapped) * swapped.across();
      };
      move = move + across(moves_);
      by_y = by_y + across(powers_);
    }
    move = numbers(moves_.swapped) * swapped + (numbers(moves_.along) * y + move);
    by_y = numbers(powers_.swapped) * swapped + (numbers(powers_.along) * y + by_y);
    const Four corrected = move + Four::load(motion.low.data());
    double at_rest = steady_at_rest_;
    if (turns_at_rest_) {
      const double c1 = phasor_.cosine.all[0];
      const double s1 = phasor_.sine.all[0];
      at_rest += (at_rest_[0] * c1 + at_rest_[1] * s1) +
                 (at_rest_[2] * (c1 * c1 - s1 * s1) + at_rest_[3] * (2.0 * c1 * s1));
    }
    // Advances the phasor to the end of the step.
    (cosine * numbers(turn_.cosine) -
     (sine * numbers(turn_.sine) -
      (cosine * numbers(turn_low_.cosine) - sine * numbers(turn_low_.sine))))
        .store(phasor_.cosine.all.data());
    (sine * numbers(turn_.cosine) +
     (cosine * numbers(turn_.sine) +
      (sine * numbers(turn_low_.cosine) + cosine * numbers(turn_low_.sine))))
        .store(phasor_.sine.all.data());
    next_ += nanoseconds_;
    // Compensated sums.
    const Four next = y + corrected;
    CompensatedSum work = motion.work;
    work.add((y * by_y + (next - next)).sum() + at_rest);  // no number where one of them is none
    if (__builtin_expect(!(work.high - work.high == 0.0), 0)) {
      return StepStatus::kNotFinite;
    }
    (corrected - (next - y)).store(motion.low.data());
    next.store(motion.y.data());
    motion.work = work;
    return StepStatus::kOk;
  }

  // The phasor at the start of the next step, and where that is.
  Phasor phasor_;
  std::int64_t next_ = 0;    ///< [ns]
  std::uint64_t piece_ = 0;  ///< of the drive
  int turns_left_ = 0;       ///< until it is recomputed
  bool turns_at_rest_ = false;
  bool coupled_ = false;
  std::int64_t nanoseconds_;  ///< h, if it is whole
  Phasor turn_, turn_low_;    ///< of a step, and its rounding error in double

  Columns moves_, powers_;
  Turning force_, force_power_;
  double steady_at_rest_ = 0.0;      ///< [J], of h
  std::array<double, 4> at_rest_{};  ///< [J], of h by cos, sin, and those of twice the angle
  double speed_ = std::numeric_limits<double>::quiet_NaN();  ///< [rad/s], prepared for

  LateralRotor rotor_;
  double h_;  ///< [s]
};

}  // namespace whirl_twin

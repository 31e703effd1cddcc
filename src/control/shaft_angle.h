// The angle of a shaft as whole turns and a remainder, so that its phase is as exact after a month
// as after a second. A double that holds 1e9 rad resolves 1.2e-7 rad; the remainder alone always
// resolves 4e-16 rad.
//
// The angle of rotation in a time tau, theta = v tau + a tau^2/2 + j tau^3/6, and its reduction by
// 2 pi are worked in double-double arithmetic: T. J. Dekker, "A floating-point technique for
// extending the available precision", Numer. Math. 18 (1971), with std::fma for the error of a
// product (Ogita, Rump, Oishi, "Accurate sum and dot product", SIAM J. Sci. Comput. 26 (2005)).
//
// Error of one call while |v tau|, |a tau^2/2| and |j tau^3/6| stay below 1e15 rad: theta is within
// 2^-100 of the largest of them, 8e-16 rad at most; 2 pi enters with 106 bits, so 1e15 rad reduce
// within 1e-17 rad; the last additions round by half an ulp of 2 pi each. Together below 3e-15 rad.
//
// A constant speed is turned through as in a direct digital synthesizer: a fixed-point number of
// turns per nanosecond, times whole nanoseconds, modulo one turn (J. Tierney, C. Rader, B. Gold, "A
// digital frequency synthesizer", IEEE Trans. Audio Electroacoust. 19 (1971)). The integers lose
// nothing. The rate is within 2^-104 of itself, 1e-16 rad of 1e15 rad; the phase is rounded to
// 2^-53 turns, 4e-16 rad; its product with 2 pi and the sum with the start round by half an ulp, of
// 2 pi and of 4 pi, and 2 pi itself enters twice within 2.5e-16. Together below 2.5e-15 rad.
#pragma once

#include <cstdint>

namespace whirl_twin {

/// Whole turns and a remainder.
struct ShaftAngle {
  static constexpr double kTurn = 6.283185307179586;  ///< [rad], 2 pi

  std::int64_t turns = 0;
  double remainder = 0.0;  ///< [rad], in [0, 2 pi)

  /// 2 pi turns + remainder [rad], rounded to a double.
  double total() const noexcept;
};

/// A time [s] as the unevaluated sum of two doubles: nanoseconds are not representable in one.
struct SplitTime {
  double high = 0.0;
  double low = 0.0;
};

/// An angle [rad] less whole turns, in [-pi, pi], as the unevaluated sum of two doubles.
struct SplitAngle {
  double high = 0.0;
  double low = 0.0;
};

/// Whole nanoseconds in seconds, to a relative 2^-104.
SplitTime splitTime(std::int64_t nanoseconds) noexcept;

/// The time and a further `seconds`, to a relative 2^-104.
SplitTime later(const SplitTime& time, double seconds) noexcept;

/// An angle [rad] of any size and sign as turns and remainder; |angle| <= 1e15 rad. Beyond 1e17
/// rad, as of all that advance, and beyond 1e9 rad/s at a constant speed, nothing is turned.
ShaftAngle shaftAngle(double angle) noexcept;

/// A shaft that turns at a constant speed.
class SteadyTurn {
 public:
  SteadyTurn() = default;

  /// At `angle` a time `lead` [s], in [0, 1e-9), before the instant from which at() counts;
  /// |speed| <= 1e9 rad/s.
  SteadyTurn(const ShaftAngle& angle, double speed, double lead) noexcept;

  /// The angle after whole nanoseconds, or before them; |theta| <= 1e15 rad.
  ShaftAngle at(std::int64_t nanoseconds) const noexcept {
    // Turned, in 2^-64 turns. Shifts to the right round down, of negative numbers too.
    const Int128 low = static_cast<Int128>(rate_low_) * nanoseconds;
    const Int128 turned = static_cast<Int128>(rate_high_) * nanoseconds + (low >> 64) + lead_;
    const std::int64_t turns = start_.turns + static_cast<std::int64_t>(turned >> 64);
    const auto phase = static_cast<std::int64_t>(static_cast<std::uint64_t>(turned) >> 11);
    // The product stays below 2 pi: the largest phase lies 0.8 ulp below and rounds to a whole one.
    const double remainder =
        start_.remainder + static_cast<double>(phase) * (ShaftAngle::kTurn * 0x1p-53);
    return remainder < ShaftAngle::kTurn ? ShaftAngle{turns, remainder}
                                         : ShaftAngle{turns + 1, remainder - ShaftAngle::kTurn};
  }

 private:
  __extension__ typedef __int128 Int128;  // -Wpedantic: GCC and Clang have it, the standard not

  ShaftAngle start_;
  // Turns in a nanosecond: (high 2^64 + low) 2^-128.
  std::int64_t rate_high_ = 0;
  std::uint64_t rate_low_ = 0;
  std::int64_t lead_ = 0;  // [2^-64 turns], turned in the lead, and 2^-54 turns to round with
};

/// The angle of a constant speed [rad/s] in whole nanoseconds, modulo whole turns: within 2^-103 of
/// all that is turned, 2^-103 rad and 2^-124 rad for each nanosecond.
SplitAngle turnIn(double speed, std::int64_t nanoseconds) noexcept;

/// The angle advanced at a constant speed [rad/s] for whole nanoseconds; |theta| <= 1e15 rad, which
/// covers 1e5 rad/s for 300 years.
ShaftAngle advance(const ShaftAngle& angle, double speed, std::int64_t nanoseconds) noexcept;

/// The angle advanced for a time from a given speed [rad/s] and acceleration [rad/s^2] at a
/// constant jerk [rad/s^3].
ShaftAngle advance(const ShaftAngle& angle, double speed, double acceleration, double jerk,
                   const SplitTime& time) noexcept;

}  // namespace whirl_twin

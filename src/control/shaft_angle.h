// The angle of a shaft as whole turns and a remainder, so that its phase is as exact after a month
// as after a second. A double that holds 1e9 rad resolves 1.2e-7 rad; the remainder alone always
// resolves 4e-16 rad.
//
// What is turned in a time tau, theta = v tau + a tau^2/2 + j tau^3/6, and its reduction by 2 pi
// are worked in double-double arithmetic: T. J. Dekker, "A floating-point technique for extending
// the available precision", Numer. Math. 18 (1971), with std::fma for the error of a product
// (Ogita, Rump, Oishi, "Accurate sum and dot product", SIAM J. Sci. Comput. 26 (2005)).
//
// Error of one call while |v tau|, |a tau^2/2| and |j tau^3/6| stay below 1e15 rad: theta is within
// 2^-100 of the largest of them, 8e-16 rad at most; 2 pi enters with 106 bits, so 1e15 rad reduce
// within 1e-17 rad; the last additions round by half an ulp of 2 pi each. Together below 3e-15 rad.
#pragma once

#include <cstdint>

namespace whirl_twin {

/// Whole turns and a remainder.
struct ShaftAngle {
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

/// Whole nanoseconds in seconds, to a relative 2^-104.
SplitTime splitTime(std::int64_t nanoseconds) noexcept;

/// The time and a further `seconds`, to a relative 2^-104.
SplitTime later(const SplitTime& time, double seconds) noexcept;

/// An angle [rad] of any size and sign as turns and remainder; |angle| <= 1e15 rad.
ShaftAngle shaftAngle(double angle) noexcept;

/// The angle advanced at a constant speed [rad/s] for whole nanoseconds; |theta| <= 1e15 rad, which
/// covers 1e5 rad/s for 300 years.
ShaftAngle advance(const ShaftAngle& angle, double speed, std::int64_t nanoseconds) noexcept;

/// The angle advanced for a time from a given speed [rad/s] and acceleration [rad/s^2] at a
/// constant jerk [rad/s^3].
ShaftAngle advance(const ShaftAngle& angle, double speed, double acceleration, double jerk,
                   const SplitTime& time) noexcept;

}  // namespace whirl_twin

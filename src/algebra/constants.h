// Numbers with one meaning everywhere, and the units that are converted to SI by a factor.
#pragma once

#include <limits>

namespace whirl_twin {

/// Half a revolution [rad].
inline constexpr double kPi = 3.14159265358979323846;
/// One revolution [rad].
inline constexpr double kTwoPi = 2.0 * kPi;
/// Positive infinity.
inline constexpr double kInfinity = std::numeric_limits<double>::infinity();
/// A quiet NaN.
inline constexpr double kNaN = std::numeric_limits<double>::quiet_NaN();
/// One revolution per minute [rad/s].
inline constexpr double kRpm = kTwoPi / 60.0;
/// One degree [rad].
inline constexpr double kDegree = kPi / 180.0;
/// One nanosecond [s].
inline constexpr double kNanosecond = 1.0e-9;

}  // namespace whirl_twin

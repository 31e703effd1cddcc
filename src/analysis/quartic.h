// A quartic, the characteristic polynomial of two coordinates, judged in well under a microsecond:
// Routh's first column in doubles, with a bound of its rounding, and the margins from its two
// quadratic factors (Ferrari's resolvent, polished by Newton's method on the factors). What it
// cannot be sure of it says, for routh() and roots() to tell, which are exact and slow.
#pragma once

#include <array>
#include <complex>

namespace whirl_twin {

struct QuarticJudgement {
  bool sure = false;  ///< of `right`: no rounding could change it
  int right = 0;      ///< roots right of the imaginary axis; where it is sure none lies on it

  bool factored = false;           ///< what follows holds, to the condition of the roots
  std::complex<double> rightmost;  ///< [1/s], Im >= 0
  double largest = 0.0;            ///< [1/s], |s| of the root farthest out
  double decay_rate = 0.0;         ///< [1/s], -max Re s
  double damping_ratio = 0.0;      ///< [-], min of -Re s / |s|
};

/// Coefficients highest power first. Real-time safe.
QuarticJudgement judgeQuartic(const std::array<double, 5>& coefficients) noexcept;

}  // namespace whirl_twin

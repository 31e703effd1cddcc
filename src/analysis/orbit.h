// The orbit of a point that vibrates at one frequency across a shaft. With x = Re(X e^(i wt)) and
// y = Re(Y e^(i wt)) the place z = x + i y is two circles, one with the rotation, one against it:
//
//   z = f e^(i wt) + b e^(-i wt),   f = (X + i Y) / 2,   b = conj(X - i Y) / 2,
//
// an ellipse of semi-axes |f| + |b| and ||f| - |b||, the long one at the angle (arg f + arg b) / 2
// from x, run forward where |f| > |b| (Genta, Dynamics of Rotating Systems, 2005).
#pragma once

#include <cmath>
#include <complex>

#include "algebra/constants.h"

namespace whirl_twin {

enum class Whirl {
  kForward,   ///< with the rotation
  kBackward,  ///< against it
  kMixed,     ///< forward at some places along the shaft, backward at others
  kStraight   ///< to and fro: in a plane
};

constexpr const char* name(Whirl whirl) {
  switch (whirl) {
    case Whirl::kForward:
      return "forward";
    case Whirl::kBackward:
      return "backward";
    case Whirl::kMixed:
      return "mixed";
    case Whirl::kStraight:
      break;
  }
  return "straight";
}

struct Orbit {
  std::complex<double> x, y;               ///< X, Y [m]
  std::complex<double> forward, backward;  ///< f, b [m]

  Orbit() = default;
  Orbit(const std::complex<double>& x_now, const std::complex<double>& y_now)
      : x(x_now),
        y(y_now),
        forward(0.5 * (x + std::complex<double>(0.0, 1.0) * y)),
        backward(0.5 * std::conj(x - std::complex<double>(0.0, 1.0) * y)) {}

  /// [m], semi-axes.
  double major() const { return std::abs(forward) + std::abs(backward); }
  double minor() const { return std::fabs(std::abs(forward) - std::abs(backward)); }
  /// [rad] in (-pi/2, pi/2], of the long axis from x; 0 for a circle.
  double inclination() const {
    if (forward == 0.0 || backward == 0.0) {
      return 0.0;
    }
    const double angle = std::remainder(0.5 * (std::arg(forward) + std::arg(backward)), kPi);
    return angle <= -0.5 * kPi ? 0.5 * kPi : angle;
  }
  /// kForward, kBackward or, thinner than kStraightest, kStraight.
  Whirl direction() const {
    const double f = std::abs(forward);
    const double b = std::abs(backward);
    if (std::fabs(f - b) <= kStraightest * (f + b)) {
      return Whirl::kStraight;
    }
    return f > b ? Whirl::kForward : Whirl::kBackward;
  }

  static constexpr double kStraightest = 1.0e-9;  ///< minor / major: less is rounding
};

}  // namespace whirl_twin

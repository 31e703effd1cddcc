// Order vectors of a synchronous motion. A centre z = x + i y that moves with k times the angle
// theta of the shaft (from its phase reference) is
//
//   z = f e^(i k theta) + b e^(-i k theta)
//
// a forward circle of radius |f| and a backward one of radius |b|: an ellipse. A probe along x
// measures Re((f + conj b) e^(i k theta)), one along y Re(-i (f - conj b) e^(i k theta)). Lags are
// counted as the phase of WhirlState: the angle of the motion behind the phase reference.
#pragma once

#include <cmath>
#include <complex>

namespace whirl_twin {

struct OrderVector {
  double order = 1.0;             ///< k, of any size
  std::complex<double> forward;   ///< f [m]
  std::complex<double> backward;  ///< b [m]
  /// [m], how far f and b may be off: the standard deviation of either part as for white noise, and
  /// more where they change faster than the filter follows.
  double deviation = 0.0;

  double forwardLag() const { return -std::arg(forward); }                 ///< [rad], -pi..pi
  double backwardLag() const { return -std::arg(backward); }               ///< [rad], likewise
  double major() const { return std::abs(forward) + std::abs(backward); }  ///< [m], semi-axis
  double minor() const { return std::fabs(std::abs(forward) - std::abs(backward)); }  ///< [m]
  /// Amplitude [m] and angle at a probe: Re(alongX() e^(i k theta)).
  std::complex<double> alongX() const { return forward + std::conj(backward); }
  std::complex<double> alongY() const {
    return std::complex<double>(0.0, -1.0) * (forward - std::conj(backward));
  }
};

/// The same order without a vector that is known to be there at any speed: the slow roll, which is
/// the bow of the shaft and the run-out of its surface.
inline OrderVector without(const OrderVector& whole, const OrderVector& slow_roll) {
  OrderVector rest = whole;
  rest.forward -= slow_roll.forward;
  rest.backward -= slow_roll.backward;
  rest.deviation = std::hypot(whole.deviation, slow_roll.deviation);
  return rest;
}

}  // namespace whirl_twin

// Order tracking filter: forward and backward components of a whirl at 1, 2, ... times the shaft
// speed, online and in run-ups, separated from the mean position (gap, sag) and from
// non-synchronous components (oil whirl and whip, free vibration).
//
// Least squares (harmonic_fit.h) over a window that ends now: orders and lines with polynomial
// amplitudes, evaluated at the middle of the window. Long windows have less noise, short ones less
// lag: the window with the smallest uncertainty of the first order is used. Lines that no order
// explains are searched in the full spectrum of the residual, and included in the fit.
//
// An amplitude that changes strongly within a turn cannot be separated from a neighbouring order,
// by this or any other filter: for the passage of a resonance of damping ratio D at a rad/s^2 the
// error is about exp(-2 pi D w0^2 / a).
#pragma once

#include <complex>
#include <utility>
#include <vector>

#include "messages/order_state.h"
#include "signal/orbit_window.h"
#include "signal/order_vector.h"

namespace whirl_twin {

/// A non-synchronous component.
struct SpectralLine {
  double frequency = 0.0;  ///< [rad/s], > 0
  double forward = 0.0;    ///< [m], amplitude from x towards y
  double backward = 0.0;   ///< [m], the other way
  double growth = 0.0;     ///< [1/s], of the larger one
};

/// The result of a window, at its middle.
struct OrbitEstimate {
  bool valid = false;               ///< there are orders: the shaft has turned often enough
  double time = 0.0;                ///< [s]
  double delay = 0.0;               ///< [s], from there to the newest sample
  double speed = 0.0;               ///< [rad/s]
  double window = 0.0;              ///< [s], long
  std::complex<double> mean;        ///< [m], where the orbit is centred
  std::vector<OrderVector> orders;  ///< as requested
  std::vector<SpectralLine> lines;  ///< largest first
  double noise = 0.0;               ///< [m], root mean square of the residual, in one direction
  double peak_to_peak = 0.0;        ///< [m], the larger of those along x and y
  /// Area swept about the mean relative to that of a circle: 1 in the direction of rotation, -1
  /// against it, 0 on a line. Of the total motion.
  double precession = 0.0;
};

class OrderFilter {
 public:
  /// Follows these orders, all > 0; that one is best followed in a run-up which is named first. Of
  /// fractions the phase is that of whole turns since the shaft began to count them.
  explicit OrderFilter(std::vector<double> orders = {1.0, 2.0}) : orders_(std::move(orders)) {}

  void take(const OrbitSample& sample) { window_.take(sample); }
  void clear() { window_.clear(); }
  OrbitEstimate estimate() const;

 private:
  struct Reach;
  OrbitEstimate fitted(const Reach& reach, double seconds) const;

  OrbitWindow window_;
  std::vector<double> orders_;
};

// The result of an order filter as a message.

/// Without system and instant.
state::OrderState reportedOrders(const OrbitEstimate& estimate);

}  // namespace whirl_twin

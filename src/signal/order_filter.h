// A tracking filter of orders: what of a whirl turns with 1, 2, ... times the shaft, forwards and
// backwards, live and in run-ups, with the mean position (gap, sag) and what does not turn with the
// shaft (oil whirl and whip, free vibration) told apart.
//
// Least squares (harmonic_fit.h) over a window that ends now: orders and lines with polynomial
// amplitudes, read at the middle of the window. Long windows are quiet, short ones follow: that one
// is taken which leaves the least doubt about the first order. Lines that no order explains are
// looked for in the full spectrum of what the fit leaves, and fitted along.
//
// An amplitude that changes by much within a turn cannot be told from a neighbouring order, by this
// or any other filter: of a resonance of damping ratio D passed at a rad/s^2, the error is some
// exp(-2 pi D w0^2 / a).
#pragma once

#include <complex>
#include <utility>
#include <vector>

#include "messages/order_state.h"
#include "signal/orbit_window.h"
#include "signal/order_vector.h"

namespace whirl_twin {

/// A vibration that does not turn with the shaft.
struct SpectralLine {
  double frequency = 0.0;  ///< [rad/s], > 0
  double forward = 0.0;    ///< [m], amplitude from x towards y
  double backward = 0.0;   ///< [m], the other way
  double growth = 0.0;     ///< [1/s], of the larger one
};

/// What a window holds, at its middle.
struct OrbitEstimate {
  bool valid = false;               ///< there are orders: the shaft has turned often enough
  double time = 0.0;                ///< [s]
  double delay = 0.0;               ///< [s], from there to the newest sample
  double speed = 0.0;               ///< [rad/s]
  double window = 0.0;              ///< [s], long
  std::complex<double> mean;        ///< [m], where the orbit is centred
  std::vector<OrderVector> orders;  ///< as asked for
  std::vector<SpectralLine> lines;  ///< largest first
  double noise = 0.0;               ///< [m], root mean square of what is left, in one direction
  double peak_to_peak = 0.0;        ///< [m], the larger of those along x and y
  /// Area swept about the mean beside that of a circle: 1 in the direction of rotation, -1 against
  /// it, 0 on a line. Of the motion as it is, whatever it consists of.
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

// What an order filter has found, as the message that tells it.

/// Without system and instant.
state::OrderState toldOrders(const OrbitEstimate& estimate);

}  // namespace whirl_twin

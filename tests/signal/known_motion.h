// Motions with known components, sampled as by a twin or a probe pair.
#pragma once

#include <cmath>
#include <complex>
#include <functional>
#include <random>

#include "algebra/constants.h"
#include "signal/order_filter.h"

namespace whirl_twin {

using Complex = std::complex<double>;

/// Synchronous (1X) motion: unbalance response of an isotropic rotor, quasi-static in the speed.
inline Complex quasiStaticResponse(double speed, double critical, double damping_ratio,
                                   double eccentricity) {
  return eccentricity * speed * speed /
         Complex(critical * critical - speed * speed, 2.0 * damping_ratio * critical * speed);
}

struct KnownMotion {
  double step = 1.0e-3;  // [s]
  double speed = 60.0;   // [rad/s], at time 0
  double acceleration = 0.0;
  double noise = 0.0;  // [m], of each probe
  /// z [m] at a time [s], an angle [rad] and a speed [rad/s] of the shaft.
  std::function<Complex(double, double, double)> z;

  double speedAt(double t) const { return speed + acceleration * t; }
  double angleAt(double t) const { return speed * t + 0.5 * acceleration * t * t; }

  /// Fed to a filter until a time [s].
  void feed(OrderFilter& filter, double until, double from = 0.0) const {
    std::mt19937_64 random(7);
    std::normal_distribution<double> normal;
    for (auto i = std::llround(from / step); static_cast<double>(i) * step <= until; ++i) {
      filter.take(sample(i, noise * Complex(normal(random), normal(random))));
    }
  }
  OrbitSample sample(std::int64_t i, Complex noise_now = 0.0) const {
    const double t = static_cast<double>(i) * step;
    const double angle = angleAt(t);
    const Complex now = z(t, angle, speedAt(t)) + noise_now;
    const double turns = std::floor(angle / (2.0 * kPi));
    return {i,
            t,
            static_cast<std::int64_t>(turns),
            angle - 2.0 * kPi * turns,
            speedAt(t),
            now.real(),
            now.imag()};
  }
};

}  // namespace whirl_twin

#include "estimation/alarm_limits.h"

#include <cmath>

namespace whirl_twin {

double normalLimit(double probability) {
  // Newton's method on the logarithm of the tail, which is concave, from beyond the root: Q(z) <
  // e^(-z^2/2).
  constexpr double kRoot2 = 1.4142135623730951;
  constexpr double kRoot2Pi = 2.5066282746310002;
  double z = std::sqrt(-2.0 * std::log(probability));
  for (int i = 0; i < 50; ++i) {
    const double tail = 0.5 * std::erfc(z / kRoot2);
    const double density = std::exp(-0.5 * z * z) / kRoot2Pi;
    const double step = std::log(tail / probability) * tail / density;
    z += step;
    if (std::fabs(step) < 1e-14) {
      break;
    }
  }
  return z;
}

double meanSquareLimit(std::size_t count, double z) {
  const double part = 2.0 / (9.0 * static_cast<double>(count));
  const double root = 1.0 - part + z * std::sqrt(part);
  return root > 0.0 ? root * root * root : 0.0;
}

double cumulativeSumLimit(double allowance, double run_length) {
  constexpr double kOvershoot = 1.166;  // 2 * 0.583, mean overshoot of the sum
  const double aim = 2.0 * allowance * allowance * run_length;
  // e^y - 1 - y increases from 0, and exceeds y^2/2 and aim at y = 2 ln(1 + aim) + 2.
  double low = 0.0;
  double high = std::fmin(std::sqrt(2.0 * aim), 2.0 * std::log1p(aim) + 2.0);
  for (int i = 0; i < 60; ++i) {
    const double y = 0.5 * (low + high);
    (std::expm1(y) - y < aim ? low : high) = y;
  }
  return std::fmax(0.0, high / (2.0 * allowance) - kOvershoot);
}

}  // namespace whirl_twin

#include "analysis/stability_margins.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "algebra/constants.h"

namespace whirl_twin {

namespace {

double decayRateOf(const std::vector<std::complex<double>>& roots) {
  // Rightmost first.
  return roots.empty() ? std::numeric_limits<double>::infinity() : 0.0 - roots.front().real();
}

double dampingRatioOf(const std::vector<std::complex<double>>& roots) {
  double smallest = std::numeric_limits<double>::infinity();
  for (const std::complex<double>& root : roots) {
    if (root != 0.0) {
      smallest = std::min(smallest, 0.0 - root.real() / std::abs(root));
    }
  }
  return std::isfinite(smallest) ? smallest : std::numeric_limits<double>::quiet_NaN();
}

}  // namespace

double decayRate(const std::vector<double>& coefficients) {
  return decayRateOf(roots(coefficients));
}

double decayRate(const std::vector<std::complex<double>>& coefficients) {
  return decayRateOf(roots(coefficients));
}

double dampingRatio(const std::vector<double>& coefficients) {
  return dampingRatioOf(roots(coefficients));
}

double dampingRatio(const std::vector<std::complex<double>>& coefficients) {
  return dampingRatioOf(roots(coefficients));
}

double logDecrement(double damping_ratio) {
  if (!(std::fabs(damping_ratio) < 1.0)) {
    return std::numeric_limits<double>::quiet_NaN();
  }
  return kTwoPi * damping_ratio / std::sqrt((1.0 - damping_ratio) * (1.0 + damping_ratio));
}

}  // namespace whirl_twin

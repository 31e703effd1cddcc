#include "analysis/critical_speeds.h"

#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <complex>
#include <limits>

#include "analysis/equilibria.h"
#include "analysis/stability.h"

namespace whirl_twin {

namespace {

using Complex = std::complex<double>;
using Eigen::MatrixXcd;
using Eigen::MatrixXd;
using Eigen::VectorXcd;

constexpr double kHalfPower = 0.707;      // of the peak, as API RP 684 has it
constexpr double kInfinitePeak = 1.0e12;  // of this height and more a peak is rounding
constexpr double kNaN = std::numeric_limits<double>::quiet_NaN();
constexpr double kInfinity = std::numeric_limits<double>::infinity();

Linearization at(const Dynamics& dynamics, double speed) {
  return linearizationAtRest(dynamics, Eigen::VectorXd::Zero(dynamics.dof()), speed);
}

MatrixXcd dynamicStiffness(const Linearization& l, double speed) {
  return (l.stiffness + l.circulatory - speed * speed * l.mass).cast<Complex>() +
         Complex(0.0, speed) * (l.damping + l.gyroscopic).cast<Complex>();
}

double squaredMajor(const Dynamics& dynamics, double speed) {
  const double major = unbalanceResponse(dynamics, speed).major;
  return major * major;
}

/// Root of a function with opposite signs at low and high, by bisection to the last bit or two.
template <class Function>
double bisect(const Function& f, double low, double high) {
  const bool rising = f(low) < 0.0;
  for (int i = 0; i < 200 && high - low > 4.0e-16 * high; ++i) {
    const double middle = 0.5 * (low + high);
    ((f(middle) < 0.0) == rising ? low : high) = middle;
  }
  return 0.5 * (low + high);
}

/// Speeds at which to look: coarse everywhere, fine around each mode in units of its damping.
std::vector<double> lookout(const Stability& modes) {
  std::vector<double> speeds;
  const double lowest = modes.natural_frequencies.front();
  const double highest = modes.natural_frequencies.back();
  constexpr int kCoarse = 300;
  for (int i = 0; i <= kCoarse; ++i) {
    speeds.push_back(0.02 * lowest * std::pow(2500.0 * highest / lowest, double(i) / kCoarse));
  }
  for (std::size_t m = 0; m < modes.natural_frequencies.size(); ++m) {
    const double width = std::max(std::fabs(modes.damping_ratios[m]), 1.0e-12);
    for (double t = 0.01; t * width < 0.5; t *= 1.5) {
      speeds.push_back(modes.natural_frequencies[m] * (1.0 - t * width));
      speeds.push_back(modes.natural_frequencies[m] * (1.0 + t * width));
    }
  }
  std::sort(speeds.begin(), speeds.end());
  return speeds;
}

/// Where the response falls to 0.707 of the peak, going away from it by growing strides.
double halfPower(const Dynamics& dynamics, double peak_speed, double stride) {
  const double target = kHalfPower * kHalfPower * squaredMajor(dynamics, peak_speed);
  const auto excess = [&](double speed) { return squaredMajor(dynamics, speed) - target; };
  double inside = peak_speed;
  while (true) {
    const double outside = peak_speed + stride;
    if (outside <= 0.0 || outside > 1.0e3 * peak_speed) {
      return kNaN;
    }
    if (excess(outside) < 0.0) {
      return bisect(excess, std::min(inside, outside), std::max(inside, outside));
    }
    inside = outside;
    stride *= 1.25;
    if (peak_speed + stride <= 0.0 && inside > 0.0) {
      return excess(1.0e-6 * peak_speed) < 0.0 ? bisect(excess, 1.0e-6 * peak_speed, inside) : kNaN;
    }
  }
}

CriticalSpeed measured(const Dynamics& dynamics, double speed, double damping_ratio) {
  CriticalSpeed c;
  c.speed = speed;
  const UnbalanceResponse response = unbalanceResponse(dynamics, speed);
  c.forward = response.forward;
  c.peak = c.amplification_factor = kInfinity;
  c.lower = c.upper = speed;
  // Rotating damping damps the modes at rest, but not the synchronous whirl: ask the peak too.
  if (damping_ratio <= 1.0e-13 || !(response.major < kInfinitePeak)) {
    return c;
  }
  c.peak = response.major;
  const double stride = 0.05 * damping_ratio * speed;
  c.lower = halfPower(dynamics, speed, -stride);
  c.upper = halfPower(dynamics, speed, stride);
  c.amplification_factor = speed / (c.upper - c.lower);
  return c;
}

}  // namespace

UnbalanceResponse unbalanceResponse(const Dynamics& dynamics, double speed) {
  const Linearization l = at(dynamics, speed);
  // The matrices are polynomials of degree two in the speed: this difference is their derivative.
  const double delta = speed / 1024.0;
  const Linearization above = at(dynamics, speed + delta);
  const Linearization below = at(dynamics, speed - delta);
  const MatrixXd stiffness_slope =
      (above.stiffness + above.circulatory - below.stiffness - below.circulatory) / (2.0 * delta);
  const MatrixXd damping_slope =
      (above.damping + above.gyroscopic - below.damping - below.gyroscopic) / (2.0 * delta);

  VectorXcd unbalance = VectorXcd::Zero(dynamics.dof());
  unbalance[0] = 1.0;
  unbalance[1] = Complex(0.0, -1.0);
  unbalance = (l.mass.cast<Complex>() * unbalance).eval();
  const Eigen::PartialPivLU<MatrixXcd> lu(dynamicStiffness(l, speed));
  const VectorXcd x = lu.solve(speed * speed * unbalance);
  const MatrixXcd slope_matrix =
      (stiffness_slope - 2.0 * speed * l.mass).cast<Complex>() +
      Complex(0.0, 1.0) * (l.damping + l.gyroscopic + speed * damping_slope).cast<Complex>();
  const VectorXcd dx = lu.solve(2.0 * speed * unbalance - slope_matrix * x);

  const Complex i(0.0, 1.0);
  const Complex f = 0.5 * (x[0] + i * x[1]);
  const Complex b = 0.5 * (x[0] - i * x[1]);
  const Complex df = 0.5 * (dx[0] + i * dx[1]);
  const Complex db = 0.5 * (dx[0] - i * dx[1]);
  const auto rate = [](const Complex& z, const Complex& dz) {
    return z == 0.0 ? std::abs(dz) : (std::conj(z) * dz).real() / std::abs(z);
  };
  UnbalanceResponse r;
  r.major = std::abs(f) + std::abs(b);
  r.minor = std::fabs(std::abs(f) - std::abs(b));
  r.forward = std::abs(f) >= std::abs(b);
  r.slope = 2.0 * r.major * (rate(f, df) + rate(b, db));
  return r;
}

std::vector<CriticalSpeed> criticalSpeeds(const Dynamics& dynamics) {
  std::vector<CriticalSpeed> found;
  if (!dynamics.linear() || !dynamics.hasShaft() || dynamics.dof() < 2) {
    return found;
  }
  // Rotating damping changes the damping of a mode with speed, its frequency hardly: modes at rest
  // show where to look.
  const Stability modes = stability(at(dynamics, 0.0));
  if (modes.natural_frequencies.empty()) {
    return found;
  }
  const auto slope = [&](double speed) { return unbalanceResponse(dynamics, speed).slope; };
  const std::vector<double> speeds = lookout(modes);
  double low = speeds.front();
  double before = slope(low);
  for (const double high : speeds) {
    const double after = slope(high);
    if (!std::isfinite(after)) {
      continue;  // on the pole of an undamped mode
    }
    if (before > 0.0 && after < 0.0) {
      const double peak = bisect([&](double w) { return -slope(w); }, low, high);
      const auto nearest = std::min_element(
          modes.natural_frequencies.begin(), modes.natural_frequencies.end(),
          [&](double a, double b) { return std::fabs(a - peak) < std::fabs(b - peak); });
      found.push_back(measured(dynamics, peak,
                               modes.damping_ratios[static_cast<std::size_t>(
                                   nearest - modes.natural_frequencies.begin())]));
    }
    low = high;
    before = after;
  }
  return found;
}

}  // namespace whirl_twin

#include "analysis/critical_speeds.h"

#include <algorithm>
#include <cmath>
#include <complex>
#include <optional>
#include <utility>

#include "algebra/constants.h"
#include "analysis/banded_rotor.h"
#include "analysis/cyclic_coordinates.h"
#include "analysis/equilibrium_branch.h"
#include "analysis/orbit.h"
#include "analysis/polynomial_roots.h"
#include "analysis/synchronous_poles.h"
#include "analysis/synchronous_response.h"

namespace whirl_twin {

namespace {

using Complex = std::complex<double>;
using Eigen::VectorXcd;

constexpr double kHalfPower = 0.707;       // of the peak, as API RP 684 has it
constexpr double kInfinitePeak = 1.0e12;   // eccentricities: of this height a peak is rounding
constexpr double kInfiniteFactor = 1.0e9;  // amplification factor, likewise
constexpr double kUndamped = 1.0e-13;      // damping ratio, likewise
constexpr int kCriticalSpeedGrid = 300;
constexpr double kMargin = 0.01;  // a derivative needs speeds to both sides
/// Times the highest resonance: heavy damping drives a peak up.
constexpr double kCriticalSpeedReach = 50.0;

/// The response at the published station at one speed: in m, or per unit eccentricity of a rotor
/// without unbalance.
struct UnbalanceResponse {
  double major = 0.0;   ///< semi-major axis of the orbit
  bool forward = true;  ///< direction of the orbit
  double slope = 0.0;   ///< d(major^2)/dw
};

/// The rotor as observed at its published station.
class Probe {
 public:
  /// `speed` [rad/s]: one at which it has matrices.
  Probe(LinearRotor rotor, Station station, double speed)
      : rotor_(std::move(rotor)), banded_(rotor_), station_(std::move(station)) {
    if (!hasSynchronousForce(rotor_)) {
      const VectorXcd shape =
          station_.along_x.cast<Complex>() - Complex(0.0, 1.0) * station_.along_y.cast<Complex>();
      rotor_.forces = {{rotor_.matrices(speed).mass.cast<Complex>() * shape, 1, true}};
    }
  }

  const LinearRotor& rotor() const { return rotor_; }
  double major(double speed) const {
    const Factor lu(synchronousStiffness(banded_.matrices(speed), speed));
    return orbit(lu.solve(rotor_.synchronousForce(speed))).major();
  }
  UnbalanceResponse response(double speed) const;
  /// [m] of the unbalance, or the unit, seen as an eccentricity of what mass moves with it.
  double eccentricity(double speed) const {
    BandedMatrix<Complex> mass(rotor_.dof(), 0);
    mass.add(1.0, banded_.matrices(speed).mass);
    return Factor(mass).solve(rotor_.synchronousForce(speed)).cwiseAbs().maxCoeff() /
           (speed * speed);
  }

 private:
  using Factor = BandedLU<Complex>;

  Orbit orbit(const VectorXcd& x) const {
    return {station_.along_x.cast<Complex>().dot(x), station_.along_y.cast<Complex>().dot(x)};
  }
  VectorXcd forceSlope(double speed) const {
    VectorXcd sum = VectorXcd::Zero(rotor_.dof());
    for (const ShaftForce& force : rotor_.forces) {
      if (force.harmonic == 1 && force.inertial) {
        sum += 2.0 * speed * force.amplitude;
      }
    }
    return sum;
  }

  LinearRotor rotor_;
  BandedRotor banded_;
  Station station_;
};

UnbalanceResponse Probe::response(double speed) const {
  const BandedLinearization l = banded_.matrices(speed);
  const BandedMatrix<Complex> stiffness = synchronousStiffness(l, speed);
  // Matrices that are polynomials of degree two in the speed: this difference is their derivative.
  const double delta = speed / 1024.0;
  const auto stiffnessAt = [&](double there) {  // with the speed-dependent terms at `speed`
    return synchronousStiffness(banded_.matrices(there), speed);
  };
  BandedMatrix<Complex> slope = stiffnessAt(speed + delta);
  slope.add(-1.0, stiffnessAt(speed - delta));
  const Factor lu(stiffness);
  const VectorXcd x = lu.solve(rotor_.synchronousForce(speed));
  VectorXcd change_of_force = slope.times(x) / (2.0 * delta);
  change_of_force -= 2.0 * speed * l.mass.times(x);
  change_of_force += Complex(0.0, 1.0) * l.byRate().times(x);
  const Orbit now = orbit(x);
  const Orbit change = orbit(lu.solve(forceSlope(speed) - change_of_force));
  const auto rate = [](const Complex& z, const Complex& dz) {
    return z == 0.0 ? std::abs(dz) : (std::conj(z) * dz).real() / std::abs(z);
  };
  UnbalanceResponse r;
  r.major = now.major();
  r.forward = std::abs(now.forward) >= std::abs(now.backward);
  r.slope =
      2.0 * r.major * (rate(now.forward, change.forward) + rate(now.backward, change.backward));
  return r;
}

/// Where the response falls to 0.707 of the peak, going away from it by growing strides.
double halfPower(const Probe& probe, double peak_speed, double peak, double stride) {
  const auto excess = [&](double speed) { return probe.major(speed) / peak - kHalfPower; };
  double inside = peak_speed;
  double f_inside = 1.0 - kHalfPower;
  while (true) {
    double outside = peak_speed + stride;
    if (outside <= 0.0) {
      outside = 1.0e-6 * peak_speed;
    }
    if (outside == inside || outside > 1.0e3 * peak_speed) {
      return kNaN;
    }
    const double f_outside = excess(outside);
    if (f_outside < 0.0) {
      return outside < inside ? bracketedRoot(excess, outside, inside, f_outside, f_inside)
                              : bracketedRoot(excess, inside, outside, f_inside, f_outside);
    }
    inside = outside;
    f_inside = f_outside;
    stride *= 1.25;
  }
}

CriticalSpeed measured(const Probe& probe, double speed, double damping_ratio) {
  CriticalSpeed c;
  c.speed = speed;
  const UnbalanceResponse response = probe.response(speed);
  c.forward = response.forward;
  c.peak = c.amplification_factor = kInfinity;
  c.lower = c.upper = speed;
  if (damping_ratio <= kUndamped || !(response.major < kInfinitePeak * probe.eccentricity(speed))) {
    return c;
  }
  const double stride = 0.05 * damping_ratio * speed;
  const double lower = halfPower(probe, speed, response.major, -stride);
  const double upper = halfPower(probe, speed, response.major, stride);
  if (speed > kInfiniteFactor * (upper - lower)) {
    return c;
  }
  c.peak = response.major;
  c.lower = lower;
  c.upper = upper;
  c.amplification_factor = speed / (upper - lower);
  return c;
}

/// The peak in an interval at whose ends the response rises and falls.
double peakBetween(const Probe& probe, double low, double high) {
  // The slope, tamed: it has its root at the peak of a damped resonance and at an undamped pole.
  const auto fall = [&](double speed) {
    const UnbalanceResponse r = probe.response(speed);
    const double g = -r.slope / (r.major * r.major);
    return std::isfinite(g) ? g / (1.0 + g * g * (high - low) * (high - low)) : 0.0;
  };
  return bracketedRoot(fall, low, high, fall(low), fall(high));
}

/// The range of a search.
struct Search {
  Probe probe;
  double low = 0.0;   ///< [rad/s]
  double high = 0.0;  ///< [rad/s]
  bool whole = true;  ///< no critical speed lies higher
};

std::optional<Search> searchOf(const Dynamics& dynamics) {
  const std::vector<Station> stations = dynamics.stations();
  if (!dynamics.hasShaft() || stations.empty()) {
    return std::nullopt;
  }
  if (!dynamics.linear()) {
    LinearizedMotionRotor small = linearizedMotionRotor(dynamics);
    if (small.rotor.dof() == 0) {
      return std::nullopt;
    }
    return Search{Probe(std::move(small.rotor), stations.front(), small.highest),
                  (1.0 + kMargin) * small.lowest, small.highest / (1.0 + kMargin)};
  }
  Probe probe(dynamics.linearRotor(), stations.front(), 0.0);
  const Linearization matrices = probe.rotor().matrices(0.0);
  const Stability at_rest = reducedStability(matrices, rigidBodyMotions(matrices));
  if (at_rest.natural_frequencies.empty()) {
    return std::nullopt;
  }
  const bool whole = at_rest.omitted == 0;
  return Search{std::move(probe), 0.02 * at_rest.natural_frequencies.front(),
                (whole ? kCriticalSpeedReach : 1.0) * at_rest.natural_frequencies.back(), whole};
}

}  // namespace

CriticalSpeedSearch searchCriticalSpeeds(const Dynamics& dynamics) {
  CriticalSpeedSearch search;
  search.highest_speed = search.searched_to = kInfinity;
  const std::optional<Search> over = searchOf(dynamics);
  if (!over) {
    return search;
  }
  const Probe& probe = over->probe;
  const double low = over->low;
  const double high = over->high;
  search.highest_speed = probe.rotor().highest_speed;
  search.searched_to = over->whole ? kInfinity : high;
  const auto poles = synchronousPoles(probe.rotor(), low, high);
  double last = low;
  double before = probe.response(low).slope;
  for (const double speed : speedsToLookAt(poles, low, high, kCriticalSpeedGrid)) {
    const double after = probe.response(speed).slope;
    if (!std::isfinite(after)) {
      continue;  // on the pole of an undamped mode
    }
    if (before > 0.0 && after < 0.0) {
      const double peak = peakBetween(probe, last, speed);
      before = after;
      last = speed;
      if (peak > search.highest_speed) {
        ++search.beyond;
        continue;
      }
      double ratio = 1.0;
      double nearest = kInfinity;
      for (const Complex& pole : poles) {
        if (std::abs(pole - peak) < nearest) {
          nearest = std::abs(pole - peak);
          ratio = std::fabs(pole.imag()) / std::abs(pole);
        }
      }
      search.found.push_back(measured(probe, peak, ratio));
    }
    last = speed;
    before = after;
  }
  return search;
}

std::vector<CriticalSpeed> criticalSpeeds(const Dynamics& dynamics) {
  return searchCriticalSpeeds(dynamics).found;
}

}  // namespace whirl_twin

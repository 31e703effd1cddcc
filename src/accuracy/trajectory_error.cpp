#include "accuracy/trajectory_error.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "algebra/constants.h"

namespace whirl_twin {

namespace {

constexpr double kRadiusWithPhase = 1.0e-3;

/// Largest coordinates of a reference, by unit.
struct Scales {
  double length = 0.0;  ///< [m]
  double angle = 0.0;   ///< [rad], at most one
};

Scales scalesOf(const Trajectory& reference, std::size_t samples) {
  Scales scales;
  for (std::size_t i = 0; i < samples * reference.dof; ++i) {
    double& scale = reference.angular[i % reference.dof] ? scales.angle : scales.length;
    scale = std::max(scale, std::fabs(reference.coordinates[i]));
  }
  scales.angle = std::min(scales.angle, 1.0);
  return scales;
}

/// Relative to a scale that may be zero: then only a zero error is small.
double relative(double error, double scale) {
  return error == 0.0 ? 0.0 : error / scale;
}

double positionError(const Trajectory& t, const Trajectory& reference, const Scales& scales,
                     std::size_t sample) {
  double largest = 0.0;
  for (std::size_t i = 0; i < t.dof; ++i) {
    const std::size_t at = sample * t.dof + i;
    const double error = std::fabs(t.coordinates[at] - reference.coordinates[at]);
    largest = std::max(largest, relative(error, t.angular[i] ? scales.angle : scales.length));
  }
  return largest;
}

double largest(const std::vector<double>& values, std::size_t samples) {
  double found = 0.0;
  for (std::size_t i = 0; i < samples; ++i) {
    found = std::max(found, std::fabs(values[i]));
  }
  return found;
}

}  // namespace

TrajectoryError trajectoryError(const Trajectory& t, const Trajectory& reference,
                                std::size_t samples) {
  samples = std::min(samples, reference.samples());
  if (t.samples() < samples) {
    return {kInfinity, kInfinity, kInfinity, kInfinity};
  }
  TrajectoryError error;
  const Scales scales = scalesOf(reference, samples);
  const auto begin = reference.energy.begin();
  const auto [least, most] =
      std::minmax_element(begin, begin + static_cast<std::ptrdiff_t>(samples));
  const double energy_scale = std::max(largest(reference.energy, samples), *most - *least);
  const bool rotor = !reference.whirl_radius.empty();
  if (!rotor) {
    error.radius = error.phase = std::numeric_limits<double>::quiet_NaN();
  }
  const double radius_scale = rotor ? largest(reference.whirl_radius, samples) : 0.0;
  for (std::size_t k = 0; k < samples; ++k) {
    error.position = std::max(error.position, positionError(t, reference, scales, k));
    error.energy = std::max(error.energy,
                            relative(std::fabs(t.energy[k] - reference.energy[k]), energy_scale));
    if (rotor) {
      const double radius = reference.whirl_radius[k];
      error.radius =
          std::max(error.radius, relative(std::fabs(t.whirl_radius[k] - radius), radius_scale));
      const double off = t.whirl_phase[k] - reference.whirl_phase[k];
      if (radius > kRadiusWithPhase * radius_scale && std::isfinite(off)) {
        error.phase = std::max(error.phase, std::fabs(std::remainder(off, 2.0 * M_PI)));
      }
    }
  }
  return error;
}

ErrorCurve::ErrorCurve(const Trajectory& trajectory, const Trajectory& reference) {
  while (take(trajectory, reference)) {
  }
}

ErrorCurve ErrorCurve::inPartsOf(const Trajectory& whole) {
  ErrorCurve curve;
  for (std::size_t i = 0; i < whole.coordinates.size(); ++i) {
    const bool angular = whole.angular[i % whole.dof];
    double& position = curve.position_scale_.of(angular);
    position = std::max(position, std::fabs(whole.coordinates[i]));
    double& rate = curve.rate_scale_.of(angular);
    rate = std::max(rate, std::fabs(whole.rates[i]));
  }
  return curve;
}

bool ErrorCurve::take(const Trajectory& t, const Trajectory& reference) {
  const auto ratio = static_cast<std::size_t>(std::llround(t.interval / reference.interval));
  const std::size_t sample = samples();
  if (sample >= t.samples() || sample * ratio >= reference.samples()) {
    return false;
  }
  for (std::size_t i = 0; i < t.dof; ++i) {
    const std::size_t at = sample * t.dof + i;
    const std::size_t there = sample * ratio * t.dof + i;
    const auto follow = [&](double value, double right, ByUnit& scales, ByUnit& errors) {
      double& scale = scales.of(t.angular[i]);
      scale = std::max(scale, std::fabs(right));
      double& error = errors.of(t.angular[i]);
      error = std::max(error, std::fabs(value - right));
    };
    follow(t.coordinates[at], reference.coordinates[there], position_scale_, position_error_);
    follow(t.rates[at], reference.rates[there], rate_scale_, rate_error_);
  }
  position_.push_back(
      std::max(relative(position_error_.length, position_scale_.length),
               relative(position_error_.angle, std::min(position_scale_.angle, 1.0))));
  rate_.push_back(std::max(relative(rate_error_.length, rate_scale_.length),
                           relative(rate_error_.angle, rate_scale_.angle)));
  return true;
}

void ErrorCurve::holdAgainstTheSampleBefore() {
  if (samples() > 1) {
    position_.erase(position_.begin() + 1);
    rate_.erase(rate_.begin() + 1);
  }
}

double ErrorCurve::position(std::size_t sample) const {
  return sample < position_.size() ? position_[sample] : kInfinity;
}

double ErrorCurve::rate(std::size_t sample) const {
  return sample < rate_.size() ? rate_[sample] : kInfinity;
}

}  // namespace whirl_twin

#include "accuracy/trajectory_error.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace whirl_twin {

namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();
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

/// In parts of a scale that may be zero: then only no error is small.
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

std::size_t samplesWithin(const Trajectory& t, const Trajectory& reference, double tolerance) {
  std::size_t samples = std::min(t.samples(), reference.samples());
  while (true) {  // each time measured by what the motion does in the samples that are left
    const Scales scales = scalesOf(reference, samples);
    std::size_t k = 0;
    while (k < samples && positionError(t, reference, scales, k) <= tolerance) {
      ++k;
    }
    if (k == samples) {
      return samples;
    }
    samples = k;
  }
}

}  // namespace whirl_twin

#include "signal/full_spectrum.h"

#include <cmath>
#include <unsupported/Eigen/FFT>

#include "algebra/constants.h"

namespace whirl_twin {

namespace {

/// Bins, twice as many as samples at least: peaks are read between them.
Eigen::Index binsFor(Eigen::Index samples) {
  Eigen::Index bins = 2;
  while (bins < 2 * samples) {
    bins *= 2;
  }
  return bins;
}

}  // namespace

FullSpectrum::FullSpectrum(const Eigen::ArrayXcd& z, double period)
    : step_(2.0 * kPi / (static_cast<double>(binsFor(z.size())) * period)),
      resolution_(4.0 * kPi / (static_cast<double>(z.size()) * period)) {
  const Eigen::Index bins = binsFor(z.size());
  std::vector<std::complex<double>> weighted(static_cast<std::size_t>(bins));
  double weights = 0.0;
  for (Eigen::Index i = 0; i < z.size(); ++i) {
    const double at = (static_cast<double>(i) + 0.5) / static_cast<double>(z.size());
    const double weight = 0.5 - 0.5 * std::cos(2.0 * kPi * at);
    weights += weight;
    weighted[static_cast<std::size_t>(i)] = weight * z[i];
  }
  std::vector<std::complex<double>> transformed;
  Eigen::FFT<double> fft;
  fft.fwd(transformed, weighted);
  line_.resize(transformed.size());
  const std::size_t half = line_.size() / 2;
  for (std::size_t i = 0; i < line_.size(); ++i) {
    line_[(i + half) % line_.size()] = std::abs(transformed[i]) / weights;
  }
}

double FullSpectrum::frequency(std::size_t bin) const {
  return step_ * (static_cast<double>(bin) - static_cast<double>(line_.size() / 2));
}

std::optional<FullSpectrum::Peak> FullSpectrum::highest(
    const std::function<bool(double)>& pass) const {
  std::size_t best = 0;
  double mean = 0.0;
  for (std::size_t i = 0; i < line_.size(); ++i) {
    mean += line_[i] * line_[i] / static_cast<double>(line_.size());
    const bool inside = i > 0 && i + 1 < line_.size();
    if (inside && line_[i] >= line_[i - 1] && line_[i] > line_[i + 1] &&
        (best == 0 || line_[i] > line_[best]) && pass(frequency(i))) {
      best = i;
    }
  }
  if (best == 0) {
    return std::nullopt;
  }
  // The parabola through three logarithms: exact for a Gaussian, to a hundredth of a bin for Hann.
  const double left = std::log(line_[best - 1] / line_[best]);
  const double right = std::log(line_[best + 1] / line_[best]);
  const double curvature = left + right;
  const double off =
      std::isfinite(curvature) && curvature < 0.0 ? 0.5 * (left - right) / curvature : 0.0;
  Peak peak;
  peak.frequency = frequency(best) + off * step_;
  peak.amplitude = line_[best] * std::exp(-0.25 * (left - right) * off);
  peak.prominence = line_[best] * line_[best] / mean;
  return peak;
}

double FullSpectrum::precession(double speed) const {
  double swept = 0.0;
  double all = 0.0;
  for (std::size_t i = 0; i < line_.size(); ++i) {
    const double area = frequency(i) * line_[i] * line_[i];
    swept += area;
    all += std::fabs(area);
  }
  return std::copysign(1.0, speed) * swept / all;
}

}  // namespace whirl_twin

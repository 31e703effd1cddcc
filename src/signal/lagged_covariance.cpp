#include "signal/lagged_covariance.h"

#include <algorithm>
#include <cmath>

#include "algebra/constants.h"

namespace whirl_twin {

namespace {

constexpr double kSamplesPerCycle = 4.0;  // of the limit, that come out
// Kaiser's window for 60 dB (J. F. Kaiser, R. W. Schafer, IEEE Trans. ASSP 28 (1980)).
constexpr double kAttenuation = 60.0;
constexpr double kShape = 0.1102 * (kAttenuation - 8.7);

/// The modified Bessel function of order 0, by its series.
double besselI0(double x) {
  double sum = 1.0;
  double term = 1.0;
  for (int k = 1; term > 1.0e-12 * sum; ++k) {
    term *= 0.25 * x * x / (static_cast<double>(k) * k);
    sum += term;
  }
  return sum;
}

}  // namespace

Decimator::Decimator(double period, double limit)
    : period_(period),
      stride_(static_cast<std::size_t>(
          std::max(1.0, std::floor(2.0 * kPi / (kSamplesPerCycle * limit * period))))) {
  if (!filters()) {
    return;
  }
  const double cutoff = kPi / static_cast<double>(stride_);  // [rad a sample], half the rate left
  const double transition = 2.0 * (cutoff - limit * period);
  const auto half = static_cast<int>(std::ceil((kAttenuation - 8.0) / (4.57 * transition)));
  double sum = 0.0;
  for (int i = -half; i <= half; ++i) {
    const double at = static_cast<double>(i) / (half + 1);
    const double sinc = i == 0 ? cutoff / kPi : std::sin(cutoff * i) / (kPi * i);
    taps_.push_back(sinc * besselI0(kShape * std::sqrt(1.0 - at * at)) / besselI0(kShape));
    sum += taps_.back();
  }
  for (double& tap : taps_) {
    tap /= sum;
  }
  ring_.resize(taps_.size());
}

bool Decimator::take(const Eigen::VectorXcd& z) {
  if (!filters()) {
    out_ = z;
    return true;
  }
  newest_ = (newest_ + 1) % ring_.size();
  ring_[newest_] = z;
  kept_ = std::min(kept_ + 1, ring_.size());
  if (kept_ < ring_.size()) {
    since_ = stride_;
    return false;
  }
  if (++since_ < stride_) {
    return false;
  }
  since_ = 0;
  out_.setZero(z.size());
  for (std::size_t i = 0; i < taps_.size(); ++i) {
    out_ += taps_[i] * ring_[(newest_ + 1 + i) % ring_.size()];
  }
  return true;
}

namespace {

constexpr std::size_t kMaxParts = 20;  // then two become one
constexpr std::int64_t kShortestPart = 16;

}  // namespace

LaggedCovariance::LaggedCovariance(Eigen::Index stations, int first_lag, int lags)
    : first_lag_(first_lag),
      nothing_(static_cast<std::size_t>(lags), Eigen::MatrixXcd::Zero(stations, stations)),
      ring_(static_cast<std::size_t>(first_lag + lags)),
      part_samples_(kShortestPart) {}

void LaggedCovariance::beginPart() {
  if (parts_.size() == kMaxParts) {
    for (std::size_t i = 0; i < kMaxParts / 2; ++i) {
      Part& kept = parts_[i];
      if (i > 0) {
        kept = parts_[2 * i];
      }
      const Part& next = parts_[2 * i + 1];
      for (std::size_t k = 0; k < kept.sums.size(); ++k) {
        kept.sums[k] += next.sums[k];
      }
      kept.samples += next.samples;
    }
    parts_.resize(kMaxParts / 2);
    part_samples_ *= 2;
  }
  parts_.push_back({nothing_, 0});
}

void LaggedCovariance::take(const Eigen::VectorXcd& z) {
  newest_ = (newest_ + 1) % ring_.size();
  ring_[newest_] = z;
  if (++kept_ < ring_.size()) {
    return;
  }
  kept_ = ring_.size();
  if (parts_.empty() || parts_.back().samples >= part_samples_) {
    beginPart();
  }
  Part& part = parts_.back();
  const std::size_t oldest = newest_ + 1;
  const Eigen::VectorXcd& base = ring_[oldest % ring_.size()];
  for (std::size_t k = 0; k < part.sums.size(); ++k) {
    const std::size_t later = oldest + static_cast<std::size_t>(first_lag_) + k;
    part.sums[k].noalias() += ring_[later % ring_.size()] * base.adjoint();
  }
  squares_ += base.squaredNorm();
  ++part.samples;
  ++samples_;
}

double LaggedCovariance::meanSquare() const {
  return samples_ > 0 ? squares_ / static_cast<double>(samples_) : 0.0;
}

LaggedCovariance::Sums LaggedCovariance::without(std::size_t part) const {
  Sums sums = nothing_;
  std::int64_t samples = 0;
  for (std::size_t i = 0; i < parts_.size(); ++i) {
    if (i == part) {
      continue;
    }
    for (std::size_t k = 0; k < sums.size(); ++k) {
      sums[k] += parts_[i].sums[k];
    }
    samples += parts_[i].samples;
  }
  for (Eigen::MatrixXcd& sum : sums) {
    sum /= static_cast<double>(samples > 0 ? samples : 1);
  }
  return sums;
}

}  // namespace whirl_twin

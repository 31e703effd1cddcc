#include "signal/lagged_covariance.h"

namespace whirl_twin {

namespace {

constexpr std::size_t kMostParts = 20;  // then two become one
constexpr std::int64_t kShortestPart = 16;

}  // namespace

LaggedCovariance::LaggedCovariance(Eigen::Index stations, int first_lag, int lags)
    : first_lag_(first_lag),
      nothing_(static_cast<std::size_t>(lags), Eigen::MatrixXcd::Zero(stations, stations)),
      ring_(static_cast<std::size_t>(first_lag + lags)),
      part_samples_(kShortestPart) {}

void LaggedCovariance::beginPart() {
  if (parts_.size() == kMostParts) {
    for (std::size_t i = 0; i < kMostParts / 2; ++i) {
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
    parts_.resize(kMostParts / 2);
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

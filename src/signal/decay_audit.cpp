#include "signal/decay_audit.h"

#include <algorithm>
#include <cmath>

#include "algebra/constants.h"
#include "signal/full_spectrum.h"
#include "signal/harmonic_fit.h"
#include "signal/subspace_identification.h"

namespace whirl_twin {

namespace {

constexpr int kOrders = 4;  // subtracted
constexpr double kAuditBlockTurns = 40.0;
constexpr double kShortestStep = 1.0e-9;       // s; time stamps may be invalid
constexpr std::size_t kMaxBlocks = 256;        // of which the size is known
constexpr double kAuditSpeedTolerance = 0.01;  // of the speed
constexpr int kParts = 8;                      // of a record, left out one by one
constexpr int kLags = 23;
constexpr int kModes = 4;              // two of the rotor, two of what is not white
constexpr double kLagsPerCycle = 6.0;  // of the strongest line
constexpr double kSameMode = 0.15;     // of the frequency
constexpr double kMinPart = 0.1;       // of the power of the strongest mode, to be one
/// Of the motion; below, the residual is rounding and change of the orders.
constexpr double kMinVibration = 1.0e-5;
constexpr std::size_t kSpectrumSamples = 8192;

/// Sums of z(t + k lag) conj z(t) over t in [from, to), for k = 1 ... kLags: the same t for all, so
/// that growth and decay of a motion are identified as such.
std::vector<std::complex<double>> covariances(const std::vector<std::complex<double>>& z,
                                              std::size_t from, std::size_t to, std::size_t lag) {
  std::vector<std::complex<double>> sums(kLags);
  for (std::size_t k = 1; k <= sums.size(); ++k) {
    for (std::size_t t = from; t < to; ++t) {
      sums[k - 1] += z[t + k * lag] * std::conj(z[t]);
    }
  }
  return sums;
}

/// The slowest to decay of the modes that the motion consists of; `near` [rad/s]: of those about
/// that frequency.
std::optional<IdentifiedMode> slowestMode(const std::vector<std::complex<double>>& covariance,
                                          double spacing,
                                          std::optional<double> near = std::nullopt) {
  const std::vector<IdentifiedMode> modes = identifyModes(covariance, spacing, kModes);
  std::optional<IdentifiedMode> slowest;
  for (const IdentifiedMode& mode : modes) {
    const bool part = mode.power > kMinPart * modes.front().power;
    const bool about = !near || std::fabs(mode.frequency - *near) < kSameMode * std::fabs(*near);
    if (part && about && (!slowest || mode.decay_rate < slowest->decay_rate)) {
      slowest = mode;
    }
  }
  return slowest;
}

}  // namespace

void DecayAudit::clear() {
  block_.clear();
  rest_.clear();
  sizes_.clear();
  since_report_ = 0;
}

std::optional<AuditedDecay> DecayAudit::take(const OrbitSample& sample) {
  const bool follows = sample.index == next_;
  next_ = sample.index + 1;
  const bool fits = std::isfinite(sample.x) && std::isfinite(sample.y) &&
                    std::isfinite(sample.speed) && sample.speed != 0.0;
  const bool begun = !block_.empty() || !rest_.empty();
  if (!fits || (begun && (!follows || std::fabs(sample.speed - speed_) >
                                          kAuditSpeedTolerance * std::fabs(speed_)))) {
    clear();
  }
  if (!fits) {
    return std::nullopt;
  }
  if (block_.empty() && rest_.empty()) {
    speed_ = sample.speed;
  }
  if (!block_.empty()) {
    step_ = sample.time - block_.back().time;
  }
  block_.push_back(sample);
  const double turns = static_cast<double>(sample.turns - block_.front().turns) +
                       (sample.remainder - block_.front().remainder) / kTwoPi;
  if (std::fabs(turns) < kAuditBlockTurns || !(step_ >= kShortestStep)) {
    return std::nullopt;
  }
  removeOrders();
  const auto length = static_cast<std::size_t>(std::llround(window_ / step_));
  if (rest_.size() > length) {
    rest_.erase(rest_.begin(), rest_.end() - static_cast<std::ptrdiff_t>(length));
  }
  if (rest_.size() < length || since_report_ < length / 4) {
    return std::nullopt;
  }
  since_report_ = 0;
  std::optional<AuditedDecay> decay = audited();
  if (decay) {
    decay->time = sample.time;
  }
  return decay;
}

/// Of a block of turns: orders with amplitudes that may drift.
void DecayAudit::removeOrders() {
  const auto n = static_cast<Eigen::Index>(block_.size());
  Eigen::ArrayXd tau(n), angle(n), x(n), y(n);
  for (Eigen::Index i = 0; i < n; ++i) {
    const OrbitSample& s = block_[static_cast<std::size_t>(i)];
    tau[i] = 2.0 * (static_cast<double>(i) + 0.5) / static_cast<double>(n) - 1.0;
    angle[i] = kTwoPi * static_cast<double>(s.turns - block_.front().turns) + s.remainder;
    x[i] = s.x;
    y[i] = s.y;
  }
  HarmonicFit fit(tau, 2 + 4 * kOrders);
  fit.addMean(1);
  for (int k = 1; k <= kOrders && fit.hasRoom(1); ++k) {
    fit.addHarmonic(k * angle, 1);
  }
  if (!fit.solve(x, y)) {
    clear();
    return;
  }
  if (sizes_.size() == kMaxBlocks) {
    sizes_.erase(sizes_.begin());
  }
  sizes_.push_back(((x - x.mean()).square() + (y - y.mean()).square()).mean());
  for (Eigen::Index i = 0; i < n; ++i) {
    // Forward is the direction of rotation.
    rest_.push_back(speed_ < 0.0 ? std::conj(fit.rest()[i]) : fit.rest()[i]);
  }
  since_report_ += block_.size();
  block_.clear();
}

std::optional<AuditedDecay> DecayAudit::audited() const {
  double power = 0.0;
  for (const std::complex<double>& z : rest_) {
    power += std::norm(z) / static_cast<double>(rest_.size());
  }
  const double motion = *std::max_element(sizes_.begin(), sizes_.end());
  if (!(power > kMinVibration * kMinVibration * motion)) {
    return std::nullopt;
  }
  const std::size_t samples = std::min(rest_.size(), kSpectrumSamples);
  const FullSpectrum spectrum(
      Eigen::Map<const Eigen::ArrayXcd>(rest_.data() + rest_.size() - samples,
                                        static_cast<Eigen::Index>(samples)),
      step_);
  const auto strongest =
      spectrum.highest([&](double w) { return std::fabs(w) > 2.0 * spectrum.resolution(); });
  if (!strongest) {
    return std::nullopt;
  }
  const double cycle = kTwoPi / std::fabs(strongest->frequency);
  const auto lag =
      std::max<std::size_t>(1, static_cast<std::size_t>(cycle / (kLagsPerCycle * step_)));
  const double spacing = static_cast<double>(lag) * step_;

  if (rest_.size() < 2 * kLags * lag) {
    return std::nullopt;
  }
  const std::size_t length = rest_.size() - kLags * lag;
  std::vector<std::vector<std::complex<double>>> parts;
  std::vector<std::complex<double>> all(kLags);
  for (std::size_t p = 0; p < kParts; ++p) {
    parts.push_back(covariances(rest_, p * length / kParts, (p + 1) * length / kParts, lag));
    for (std::size_t k = 0; k < all.size(); ++k) {
      all[k] += parts.back()[k];
    }
  }
  const auto mode = slowestMode(all, spacing);
  if (!mode) {
    return std::nullopt;
  }
  double squares = 0.0;
  for (const auto& part : parts) {  // the jackknife (B. Efron, C. Stein, Ann. Stat. 9 (1981))
    std::vector<std::complex<double>> others = all;
    for (std::size_t k = 0; k < all.size(); ++k) {
      others[k] -= part[k];
    }
    const auto without = slowestMode(others, spacing, mode->frequency);
    if (!without) {
      return std::nullopt;
    }
    squares += std::pow(without->decay_rate - mode->decay_rate, 2.0) * (kParts - 1.0) / kParts;
  }
  AuditedDecay decay;
  decay.frequency = mode->frequency;
  decay.decay_rate = mode->decay_rate;
  decay.deviation =
      std::max(std::sqrt(squares), std::sqrt(std::max(0.0, mode->decay_rate) / window_));
  decay.vibration = std::sqrt(0.5 * power);
  return decay;
}

}  // namespace whirl_twin

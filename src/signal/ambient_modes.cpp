#include "signal/ambient_modes.h"

#include <algorithm>
#include <cmath>

#include "algebra/constants.h"
#include "signal/harmonic_fit.h"
#include "signal/subspace_identification.h"

namespace whirl_twin {

namespace {

constexpr double kAmbientBlockTurns = 100.0;
constexpr double kMinTurns = 20.0;               // of a block that is cut short
constexpr double kAmbientSpeedTolerance = 0.01;  // of the speed
constexpr int kMaxOrders = 10;
constexpr std::int64_t kMinCovarianceSamples = 200;

constexpr int kMaxHankel = 60;  // rows: blocks times stations
constexpr int kMaxBlockRows = 30;
constexpr int kMinBlockRows = 8;
constexpr int kFirstFilteredLag = 3;  // by then what the filter makes of white noise has ended

constexpr int kLowestOrder = 2;
constexpr int kMaxOrder = 24;
constexpr std::size_t kStableOrders = 4;  // in a row
constexpr double kMaxRatio = 0.35;        // damping ratio; what decays faster is noise
constexpr double kMinPower = 0.005;       // of the strongest
constexpr double kSameFrequency = 0.02;   // of it
constexpr double kSameShape = 0.9;        // modal assurance criterion
constexpr double kMaxUncertain = 0.02;    // deviation of a frequency, of it
constexpr double kNearOrder = 1.5;        // of the width of the subtracted component

int blockRows(Eigen::Index stations) {
  return std::clamp(kMaxHankel / static_cast<int>(stations), kMinBlockRows, kMaxBlockRows);
}

/// A mode as the orders see it that have found it, one after the other.
struct Chain {
  std::vector<IdentifiedMode> links;
  std::vector<int> orders;
};

/// A mode with its deviations, from the parts of a record left out one by one.
struct Scatter {
  double frequency = 0.0, decay = 0.0;  // [rad/s], [1/s], squared
  Eigen::VectorXd shape;                // squared
};

/// Of the modes that of the chain's; nullptr: it is not there.
const IdentifiedMode* same(const IdentifiedMode& as, const std::vector<IdentifiedMode>& modes) {
  const IdentifiedMode* nearest = nullptr;
  double least = 1.0;
  for (const IdentifiedMode& mode : modes) {
    const double away = std::hypot(mode.frequency - as.frequency, mode.decay_rate - as.decay_rate) /
                        std::max(kSameFrequency * std::fabs(as.frequency), 0.7 * as.decay_rate);
    if (away < least && modalAssurance(as.shape, mode.shape) > kSameShape) {
      nearest = &mode;
      least = away;
    }
  }
  return nearest;
}

/// Chains of modes that do not depend on the order.
std::vector<Chain> stableChains(const SubspaceIdentification& record, double limit) {
  std::vector<Chain> growing, stable;
  for (int order = kLowestOrder; order <= kMaxOrder; order += 2) {
    std::vector<IdentifiedMode> modes = record.modes(order);
    const double strongest = modes.empty() ? 0.0 : modes.front().power;
    modes.erase(std::remove_if(modes.begin(), modes.end(),
                               [&](const IdentifiedMode& mode) {
                                 const double f = std::fabs(mode.frequency);
                                 return f > limit || mode.power < kMinPower * strongest ||
                                        std::fabs(mode.decay_rate) > kMaxRatio * f;
                               }),
                modes.end());
    std::vector<Chain> next;
    for (Chain& chain : growing) {
      const IdentifiedMode* const found = same(chain.links.back(), modes);
      if (found != nullptr) {
        chain.links.push_back(*found);
        chain.orders.push_back(order);
        modes.erase(modes.begin() + (found - modes.data()));
        next.push_back(std::move(chain));
      } else if (chain.links.size() >= kStableOrders) {
        stable.push_back(std::move(chain));
      }
    }
    for (const IdentifiedMode& mode : modes) {
      next.push_back({{mode}, {order}});
    }
    growing = std::move(next);
  }
  for (Chain& chain : growing) {
    if (chain.links.size() >= kStableOrders) {
      stable.push_back(std::move(chain));
    }
  }
  return stable;
}

/// How a mode scatters; nothing where it is not found without one of the parts.
std::optional<Scatter> scatterOf(const IdentifiedMode& whole, int order,
                                 const std::vector<SubspaceIdentification>& others) {
  const auto parts = static_cast<double>(others.size());
  const double share = parts > 0.0 ? (parts - 1.0) / parts : 0.0;
  Scatter scatter;
  scatter.shape = Eigen::VectorXd::Zero(whole.shape.size());
  Eigen::Index largest = 0;
  whole.shape.cwiseAbs().maxCoeff(&largest);
  for (const SubspaceIdentification& other : others) {
    const std::vector<IdentifiedMode> found = other.modes(order);
    const IdentifiedMode* const mode = same(whole, found);
    if (mode == nullptr) {
      return std::nullopt;
    }
    scatter.frequency += share * std::pow(mode->frequency - whole.frequency, 2.0);
    scatter.decay += share * std::pow(mode->decay_rate - whole.decay_rate, 2.0);
    const Eigen::VectorXcd shape = mode->shape / mode->shape[largest] * whole.shape[largest];
    scatter.shape += share * (shape - whole.shape).cwiseAbs2();
  }
  return scatter;
}

/// Of a large number of parts, that 95 % lie within so many deviations: 1.96.
double studentsInterval(std::size_t parts) {
  const double free = std::max(1.0, static_cast<double>(parts) - 1.0);
  return 1.96 + 2.37 / free + 2.8 / (free * free);
}

}  // namespace

double modalAssurance(const Eigen::VectorXcd& a, const Eigen::VectorXcd& b) {
  return std::norm(a.dot(b)) / (a.squaredNorm() * b.squaredNorm());
}

AmbientModes::AmbientModes(Eigen::Index stations, double period, double speed, double limit)
    : stations_(stations),
      period_(period),
      speed_(speed),
      limit_(limit),
      orders_(static_cast<int>(
          std::clamp(1.5 * limit / std::fabs(speed), 2.0, static_cast<double>(kMaxOrders)))),
      decimator_(period, limit),
      covariance_(stations, decimator_.filters() ? kFirstFilteredLag : 1,
                  2 * blockRows(stations) - 1),
      shortest_block_(kAmbientBlockTurns) {}

double AmbientModes::turnsInBlock() const {
  if (block_.empty()) {
    return 0.0;
  }
  return std::fabs(static_cast<double>(block_.back().turns - block_.front().turns) +
                   (block_.back().remainder - block_.front().remainder) / kTwoPi);
}

void AmbientModes::take(const StationSample& sample) {
  const bool fits = sample.z.allFinite() && std::isfinite(sample.remainder) &&
                    std::fabs(sample.speed - speed_) <= kAmbientSpeedTolerance * std::fabs(speed_);
  if (!block_.empty() && (!fits || sample.index != block_.back().index + 1)) {
    endBlock(false);
  }
  if (block_.empty() && followed_ && (!fits || sample.index != *followed_)) {
    decimator_.interrupt();
    covariance_.interrupt();
    followed_ = std::nullopt;
  }
  if (!fits) {
    return;
  }
  block_.push_back(sample);
  if (turnsInBlock() >= kAmbientBlockTurns) {
    endBlock(true);
  }
}

/// The orders of a block go; whole: the next sample follows.
void AmbientModes::endBlock(bool whole) {
  const bool used = turnsInBlock() >= kMinTurns && takeBlock();
  const std::int64_t last = block_.back().index;
  block_.clear();
  if (!used || !whole) {
    decimator_.interrupt();
    covariance_.interrupt();
    followed_ = std::nullopt;
  } else {
    followed_ = last + 1;
  }
}

/// False where the samples do not determine the orders.
bool AmbientModes::takeBlock() {
  const auto n = static_cast<Eigen::Index>(block_.size());
  Eigen::ArrayXd tau(n), angle(n);
  for (Eigen::Index i = 0; i < n; ++i) {
    const StationSample& s = block_[static_cast<std::size_t>(i)];
    tau[i] = 2.0 * (static_cast<double>(i) + 0.5) / static_cast<double>(n) - 1.0;
    angle[i] = kTwoPi * static_cast<double>(s.turns - block_.front().turns) + s.remainder;
  }
  HarmonicFit fit(tau, 2 + 4 * orders_);
  fit.addMean(1);
  for (int k = 1; k <= orders_ && fit.hasRoom(1); ++k) {
    fit.addHarmonic(k * angle, 1);
  }
  Eigen::MatrixXcd rest(stations_, n);
  double before = 0.0;
  for (Eigen::Index station = 0; station < stations_; ++station) {
    Eigen::ArrayXcd z(n);
    for (Eigen::Index i = 0; i < n; ++i) {
      z[i] = block_[static_cast<std::size_t>(i)].z[station];
    }
    if (!fit.solve(z.real(), z.imag())) {
      return false;
    }
    // Forward is the direction of rotation.
    rest.row(station) = fit.rest().matrix().transpose();
    if (speed_ < 0.0) {
      rest.row(station) = rest.row(station).conjugate().eval();
    }
    before += (z - z.mean() - fit.rest()).abs2().sum();
  }
  order_squares_ += before;
  samples_ += n;
  shortest_block_ = std::min(shortest_block_, turnsInBlock());
  for (Eigen::Index i = 0; i < n; ++i) {
    speeds_ += block_[static_cast<std::size_t>(i)].speed;
    if (decimator_.take(rest.col(i))) {
      covariance_.take(decimator_.out());
    }
  }
  return true;
}

std::optional<AmbientRecord> AmbientModes::record() {
  if (!block_.empty()) {
    endBlock(false);
  }
  if (covariance_.samples() < kMinCovarianceSamples) {
    return std::nullopt;
  }
  AmbientRecord record;
  record.duration = static_cast<double>(covariance_.samples()) * decimator_.spacing();
  record.speed = speeds_ / static_cast<double>(samples_);
  record.limit = limit_;
  const double directions = 2.0 * static_cast<double>(stations_);
  record.vibration = std::sqrt(covariance_.meanSquare() / directions);
  record.orders = std::sqrt(order_squares_ / static_cast<double>(samples_) / directions);
  record.interval = studentsInterval(covariance_.parts());
  record.modes = identified();
  return record;
}

std::vector<AmbientMode> AmbientModes::identified() const {
  const int first_lag = decimator_.filters() ? kFirstFilteredLag : 1;
  const double duration = static_cast<double>(covariance_.samples()) * decimator_.spacing();
  const auto identification = [&](std::size_t left_out) {
    return SubspaceIdentification(covariance_.without(left_out), decimator_.spacing(), first_lag);
  };
  std::vector<AmbientMode> modes;
  const std::vector<Chain> chains = stableChains(identification(covariance_.parts()), limit_);
  std::vector<SubspaceIdentification> others;
  for (std::size_t part = 0; part < covariance_.parts() && !chains.empty(); ++part) {
    others.push_back(identification(part));
  }
  for (const Chain& chain : chains) {
    // Low orders scatter less, high ones separate neighbouring modes: the one with the smallest
    // scatter.
    std::optional<Scatter> least;
    std::size_t best = 0;
    for (const std::size_t link :
         {std::size_t{0}, chain.links.size() / 4, chain.links.size() / 2}) {
      const std::optional<Scatter> scatter =
          scatterOf(chain.links[link], chain.orders[link], others);
      if (scatter && (!least || scatter->decay < least->decay)) {
        least = scatter;
        best = link;
      }
    }
    if (!least) {
      continue;
    }
    const IdentifiedMode& whole = chain.links[best];
    const double limit_of_theory = std::sqrt(std::max(0.0, whole.decay_rate) / duration);
    AmbientMode mode;
    mode.frequency = whole.frequency;
    mode.frequency_deviation = std::max(std::sqrt(least->frequency), limit_of_theory);
    mode.decay_rate = whole.decay_rate;
    mode.decay_deviation = std::max(std::sqrt(least->decay), limit_of_theory);
    mode.power = whole.power / covariance_.meanSquare();
    mode.shape = whole.shape;
    mode.shape_deviation = least->shape.cwiseSqrt();
    const double k = std::fabs(mode.frequency / speed_);
    if (std::round(k) >= 1.0 && std::round(k) <= orders_ &&
        std::fabs(k - std::round(k)) < kNearOrder / shortest_block_) {
      mode.order = static_cast<int>(std::round(k));
    }
    const bool sure = mode.frequency_deviation < kMaxUncertain * std::fabs(mode.frequency);
    const bool grows_surely = mode.decay_rate < -3.0 * mode.decay_deviation;
    if (sure && (mode.decay_rate > 0.0 || grows_surely)) {
      modes.push_back(std::move(mode));
    }
  }
  std::sort(modes.begin(), modes.end(), [](const AmbientMode& a, const AmbientMode& b) {
    return std::fabs(a.frequency) < std::fabs(b.frequency);
  });
  return modes;
}

}  // namespace whirl_twin

#include "analysis/mode_tracking.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <tuple>
#include <utility>

#include "algebra/dense.h"
#include "analysis/lowest_eigenvalues.h"
#include "analysis/stability.h"

namespace whirl_twin {

namespace {

using Complex = std::complex<double>;
using Eigen::VectorXcd;

constexpr int kMaxContinuationSteps = 12;
constexpr double kContinuationTolerance = 1.0e-13;  // of the eigenvalue
constexpr double kGoodEnough = 1.0e-9;              // of it, where rounding lets it come no nearer

}  // namespace

ModeContinuation::ModeContinuation(const BandedLinearization& l)
    : mass_(l.mass),
      by_rate_(l.byRate()),
      by_place_(l.byPlace()),
      stiffness_(l.stiffness),
      damping_(l.damping),
      definite_(hasCholesky(l.stiffness)),
      cannot_grow_(definite_ && l.circulatory.isZero()) {}

Complex ModeContinuation::product(const WhirlMode& a, const WhirlMode& b) const {
  return a.shape.dot(stiffness_.times(b.shape).col(0)) +
         std::conj(a.eigenvalue) * b.eigenvalue * a.shape.dot(mass_.times(b.shape).col(0));
}

std::optional<WhirlMode> ModeContinuation::from(const WhirlMode& mode, double least) const {
  if (!definite_) {
    return std::nullopt;
  }
  WhirlMode found;
  Complex s = mode.eigenvalue;
  VectorXcd x = mode.shape.normalized();
  double last = std::abs(s);
  for (int step = 0;; ++step) {
    BandedMatrix<Complex> dynamic(mass_.size(), 0);
    dynamic.add(1.0, by_place_);
    dynamic.add(s, by_rate_);
    dynamic.add(s * s, mass_);
    const VectorXcd slope = by_rate_.times(x) + 2.0 * s * mass_.times(x);
    const VectorXcd y = BandedLU<Complex>(dynamic).solve(slope);
    const Complex change = 1.0 / x.dot(y);
    const double size = std::abs(change);
    if (!std::isfinite(size) || step == kMaxContinuationSteps) {
      return std::nullopt;
    }
    s -= change;
    x = y.normalized();
    if (size <= kContinuationTolerance * std::abs(s) ||
        (size <= kGoodEnough * std::abs(s) && size > 0.5 * last)) {
      break;
    }
    last = size;
  }
  found.eigenvalue = s;
  found.shape = x;
  if (!(s.imag() > kGoodEnough * std::abs(s)) ||
      !(std::norm(product(mode, found)) >=
        least * product(mode, mode).real() * product(found, found).real())) {
    return std::nullopt;
  }
  if (cannot_grow_ && std::fabs(s.real()) <= kDoubtfulRealPart * std::abs(s)) {
    // s^2 m + s (c + i g) + k = 0 times conj(s): what damping takes out, without the rounding of s.
    const double m = x.dot(mass_.times(x).col(0)).real();
    const double c = x.dot(damping_.times(x).col(0)).real();
    const double k = x.dot(stiffness_.times(x).col(0)).real();
    found.eigenvalue = {-c * std::norm(s) / (m * std::norm(s) + k), s.imag()};
  }
  return found;
}

namespace {

using Eigen::Index;
using Eigen::MatrixXcd;
using Eigen::MatrixXd;
using Eigen::VectorXcd;

constexpr double kSameModeCorrelation = 0.9;  // correlation of one mode at two speeds
constexpr double kAtAll = 0.5;            // the minimum accepted where a step is no longer halved
constexpr double kRepeatedMode = 1.0e-6;  // of an eigenvalue
constexpr int kMaxStrideHalvings = 8;
/// Of more coordinates all modes at a speed cost more than Newton's method for those followed.
constexpr Index kFewCoordinates = 40;
constexpr std::size_t kMoreModes = 12;  // than are followed, where others may come in between

/// Square root of the energy: the scalar product of states scaled by it is that of the energy.
class EnergyScale {
 public:
  explicit EnergyScale(const Linearization& l) : mass_(Cholesky(l.mass).lower().transpose()) {
    const Cholesky stiffness(l.stiffness);
    // With a motion that has no stiffness: another length.
    stiffness_ =
        stiffness.succeeded()
            ? MatrixXd(stiffness.lower().transpose())
            : MatrixXd(std::sqrt(l.stiffness.cwiseAbs().maxCoeff() / l.mass.cwiseAbs().maxCoeff()) *
                       mass_);
  }
  VectorXcd scaled(const WhirlMode& mode) const {
    const Index n = mode.shape.size();
    VectorXcd state(2 * n);
    state.head(n) = stiffness_ * mode.shape;
    state.tail(n) = mode.eigenvalue * (mass_ * mode.shape);
    return state;
  }

 private:
  MatrixXd mass_, stiffness_;
};

/// Modes of one eigenvalue: any sum of them is a mode.
struct Space {
  std::vector<std::size_t> members;
  MatrixXcd states, basis;  // scaled, in the lengths of the modes; orthonormal
  std::size_t taken = 0;
};

std::vector<Space> spacesOf(const std::vector<WhirlMode>& modes, const EnergyScale& scale) {
  std::vector<Space> spaces;
  for (std::size_t i = 0; i < modes.size(); ++i) {
    const bool repeated = i > 0 && std::abs(modes[i].eigenvalue - modes[i - 1].eigenvalue) <=
                                       kRepeatedMode * std::abs(modes[i].eigenvalue);
    if (!repeated) {
      spaces.emplace_back();
    }
    spaces.back().members.push_back(i);
  }
  for (Space& space : spaces) {
    const auto count = static_cast<Index>(space.members.size());
    space.states.resize(2 * modes.front().shape.size(), count);
    for (Index k = 0; k < count; ++k) {
      space.states.col(k) = scale.scaled(modes[space.members[static_cast<std::size_t>(k)]]);
    }
    space.basis = orthonormalBasis(space.states);
  }
  return spaces;
}

/// The mode nearest to a scaled state within its space.
WhirlMode nearestIn(const Space& space, std::size_t member, const VectorXcd& state,
                    const std::vector<WhirlMode>& modes, const std::vector<Station>& stations) {
  WhirlMode mode = modes[space.members[member]];
  if (space.members.size() == 1) {
    return mode;
  }
  const VectorXcd parts = leastSquares(space.states, state);
  mode.shape.setZero();
  for (std::size_t k = 0; k < space.members.size(); ++k) {
    mode.shape += parts[static_cast<Index>(k)] * modes[space.members[k]].shape;
  }
  normalise(mode, stations);
  return mode;
}

/// At least the `count` lowest, or as many as there are.
std::vector<WhirlMode> modesOf(const Linearization& matrices, const std::vector<Station>& stations,
                               std::size_t count) {
  if (matrices.mass.rows() > kMaxCompleteCoordinates &&
      2 * count < static_cast<std::size_t>(matrices.mass.rows())) {
    if (auto lowest = lowestWhirlModes(banded(matrices), stations, count)) {
      if (lowest->modes.size() >= count) {
        return std::move(lowest->modes);
      }
    }
  }
  return whirlModes(matrices, stations).modes;
}

/// Each mode by Newton's method from where it was; nothing unless all are found, each a mode of
/// its own.
std::optional<ModeTracker::Modes> continued(const ModeTracker::Modes& modes,
                                            const Linearization& matrices,
                                            const std::vector<Station>& stations) {
  const ModeContinuation continuation(banded(matrices));
  ModeTracker::Modes found(modes.size());
  for (std::size_t i = 0; i < modes.size(); ++i) {
    if (!modes[i]) {
      continue;
    }
    found[i] = continuation.from(*modes[i], kSameModeCorrelation);
    if (!found[i]) {
      return std::nullopt;
    }
    for (std::size_t k = 0; k < i; ++k) {
      if (found[k] && std::abs(found[k]->eigenvalue - found[i]->eigenvalue) <=
                          kRepeatedMode * std::abs(found[i]->eigenvalue)) {
        return std::nullopt;
      }
    }
    normalise(*found[i], stations);
  }
  return found;
}

}  // namespace

ModeTracker::ModeTracker(System system, std::vector<Station> stations)
    : system_(std::move(system)), stations_(std::move(stations)) {}

ModeTracker::Modes ModeTracker::lowest(double parameter, std::size_t count) const {
  const std::vector<WhirlMode> all = modesOf(system_(parameter), stations_, count);
  const std::size_t found = std::min(count, all.size());
  return {all.begin(), all.begin() + static_cast<std::ptrdiff_t>(found)};
}

ModeTracker::Modes ModeTracker::follow(const Modes& modes, double from, double to) const {
  return follow(modes, from, to, kMaxStrideHalvings);
}

ModeTracker::Modes ModeTracker::follow(const Modes& modes, double from, double to,
                                       int halvings) const {
  const Linearization matrices = system_(to);
  if (matrices.mass.rows() > kFewCoordinates) {
    if (auto found = continued(modes, matrices, stations_)) {
      return *found;
    }
  }
  const EnergyScale scale(matrices);
  const std::vector<WhirlMode> there = modesOf(matrices, stations_, modes.size() + kMoreModes);
  std::vector<Space> spaces = there.empty() ? std::vector<Space>() : spacesOf(there, scale);

  std::vector<VectorXcd> states(modes.size());
  std::vector<std::tuple<double, std::size_t, std::size_t>> pairs;  // correlation, mode, space
  for (std::size_t i = 0; i < modes.size(); ++i) {
    if (modes[i]) {
      states[i] = scale.scaled(*modes[i]).normalized();
      for (std::size_t k = 0; k < spaces.size(); ++k) {
        pairs.emplace_back((spaces[k].basis.adjoint() * states[i]).squaredNorm(), i, k);
      }
    }
  }
  std::sort(pairs.begin(), pairs.end(), std::greater<>());

  Modes found(modes.size());
  for (const auto& [correlation, i, k] : pairs) {
    if (found[i] || spaces[k].taken == spaces[k].members.size() ||
        correlation < (halvings > 0 ? kSameModeCorrelation : kAtAll)) {
      continue;
    }
    found[i] = nearestIn(spaces[k], spaces[k].taken++, states[i], there, stations_);
  }
  const bool all = std::equal(modes.begin(), modes.end(), found.begin(),
                              [](const auto& a, const auto& b) { return !a || b; });
  if (all || halvings == 0) {
    return found;
  }
  const double middle = 0.5 * (from + to);
  return follow(follow(modes, from, middle, halvings - 1), middle, to, halvings - 1);
}

}  // namespace whirl_twin

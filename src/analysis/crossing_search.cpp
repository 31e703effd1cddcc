#include "analysis/crossing_search.h"

#include <algorithm>
#include <cmath>

#include "algebra/constants.h"
#include "analysis/lowest_eigenvalues.h"
#include "analysis/stability.h"
#include "analysis/unstable_root_bound.h"

namespace whirl_twin {

namespace {

using Complex = std::complex<double>;
using Eigen::VectorXcd;

constexpr double kMet = 1.0e-6;  // of a frequency: as near as a mode comes that meets it
/// asinh of decay over h w: from a growth of 30 to the most damping of a whirl (isWhirl), 0.7. What
/// decays hardly is counted apart.
constexpr std::array<double, 4> kBands{-4.0945, -1.1, 0.3, 0.86730053};
constexpr double kAside = 0.4877;  // of a rectangle: no round number, where a mode may be
constexpr double kSame = 1.0e-9;   // of a speed, within which crossings are one
constexpr int kMaxBisections = 80;
// Of a path: the longest step, and as a part of h w, the distance to overdamped roots, two of which
// turn the phase a whole time; the largest turn of a step, and by how much it may differ from that
// which the slopes at its ends make; the shortest step; that of a difference.
constexpr double kMaxStep = 0.05, kWide = 0.4, kMaxTurn = 1.0, kTurnError = 0.03,
                 kShortestStep = 1.0e-10, kDifference = 1.0e-6;
constexpr int kNewtonSteps = 40;

double ratioOf(double x) {
  return std::sinh(x);
}

}  // namespace

struct CrossingSearch::Search {
  const std::vector<MetSpeed>& known;
  std::vector<FoundCrossing> found;

  /// How many of them slow less those that do not, and how many there are.
  std::pair<int, int> within(const Rectangle& r) const {
    std::pair<int, int> counts{0, 0};
    for (const MetSpeed& one : known) {
      const double x = std::asinh(one.decay);
      if (x >= r.left && x < r.right && one.speed >= r.low && one.speed < r.high) {
        counts.first += one.slows ? 1 : -1;
        ++counts.second;
      }
    }
    return counts;
  }
};

Complex CrossingSearch::phase(const BandedLinearization& l, double x, double speed) const {
  const Complex s = harmonic_ * speed * Complex(-ratioOf(x), 1.0);
  return BandedLU<Complex>(pencilOf(l).at(s)).determinantPhase();
}

double CrossingSearch::turn(const Edge& edge) const {
  const auto known = turns_.find(edge);
  return known != turns_.end() ? known->second : turns_[edge] = turnOnce(edge);
}

/// By how much the phase turns [rad]; NaN where a root is on the way.
double CrossingSearch::turnOnce(const Edge& edge) const {
  const auto [x_from, w_from, x_to, w_to] = edge;
  const bool at_one_speed = w_from == w_to;
  const BandedLinearization fixed = rotor_.matrices(w_from);
  const auto at = [&, x0 = x_from, w0 = w_from, dx = x_to - x_from, dw = w_to - w_from](double u) {
    const double speed = w0 + u * dw;
    return phase(at_one_speed ? fixed : rotor_.matrices(speed), x0 + u * dx, speed);
  };
  const auto slope = [&](double u, const Complex& there) {
    const double d = u + kDifference > 1.0 ? -kDifference : kDifference;
    return std::arg(at(u + d) * std::conj(there)) / d;
  };
  double sum = 0.0, u = 0.0, step = 0.5 * kMaxStep;
  Complex before = at(0.0);
  double rate = slope(0.0, before);
  while (u < 1.0) {
    const double x = x_from + u * (x_to - x_from), speed = w_from + u * (w_to - w_from);
    const double wide = std::hypot(
        speed * std::cosh(x) * (x_to - x_from) + ratioOf(x) * (w_to - w_from), w_to - w_from);
    step = std::min({2.0 * step, kMaxStep, kWide * speed / wide, 0.6 / (std::fabs(rate) + 1.0e-9)});
    for (;; step *= 0.5) {
      if (!(step > kShortestStep) || !(std::norm(before) > 0.0)) {
        return kNaN;
      }
      const double next = std::min(1.0, u + step);
      const Complex after = at(next);
      const double next_rate = slope(next, after);
      const double expected = 0.5 * (next - u) * (rate + next_rate);
      const double off = std::remainder(std::arg(after * std::conj(before)) - expected, kTwoPi);
      if (std::fabs(off) <= kTurnError && std::fabs(expected) <= kMaxTurn) {
        sum += expected + off;
        u = next;
        before = after;
        rate = next_rate;
        break;
      }
    }
  }
  return sum;
}

/// How many modes fall behind within, less those that outrun the speed.
std::optional<int> CrossingSearch::slowed(const Rectangle& r) const {
  const double turned =
      turn({r.left, r.low, r.right, r.low}) + turn({r.right, r.low, r.right, r.high}) -
      turn({r.left, r.high, r.right, r.high}) - turn({r.left, r.low, r.left, r.high});
  return std::isnan(turned) ? std::nullopt
                            : std::optional<int>(-static_cast<int>(std::lround(turned / kTwoPi)));
}

void CrossingSearch::look(const Rectangle& r, int halvings, Search& search) const {
  const auto net = slowed(r);
  const auto [known, count] = search.within(r);
  if (!net || *net == known || halvings == kMaxBisections) {
    return;
  }
  if (count == 0 && std::abs(*net) == 1 && r.high - r.low < 0.2 * r.high &&
      r.right - r.left < 1.5) {
    if (auto found = refined(r, *net > 0)) {
      search.found.push_back(std::move(*found));
      return;
    }
  }
  if (r.high - r.low < kSame * r.high) {
    addRepeated(r, *net > 0, search);
    return;
  }
  Rectangle first = r, second = r;
  if (10.0 * (r.high - r.low) > r.high * (r.right - r.left)) {
    first.high = second.low = r.low + kAside * (r.high - r.low);
  } else {
    first.right = second.left = r.left + kAside * (r.right - r.left);
  }
  look(first, halvings + 1, search);
  look(second, halvings + 1, search);
}

/// By Newton's method in both coordinates for 1 / (u . D^-1 v), which is smooth even where two
/// eigenvalues meet, and zero where D is singular; if that leads to one within.
std::optional<FoundCrossing> CrossingSearch::refined(const Rectangle& r, bool slows) const {
  double x = 0.5 * (r.left + r.right);
  double speed = 0.5 * (r.low + r.high);
  const auto size = rotor_.matrices(speed).size();
  VectorXcd u(size), v(size);
  for (Eigen::Index i = 0; i < size; ++i) {
    const auto place = static_cast<double>(i);
    u[i] = {1.0 + 0.3 * std::sin(1.0 + 2.4 * place), 0.3 * std::cos(1.7 * place)};
    v[i] = {1.0 + 0.3 * std::cos(2.0 + 2.9 * place), 0.3 * std::sin(1.3 * place)};
  }
  const auto rootAt = [&](double there, double w) {
    return harmonic_ * w * Complex(-ratioOf(there), 1.0);
  };
  const auto solved = [&](double there, double w, const VectorXcd& right) -> VectorXcd {
    return BandedLU<Complex>(pencilOf(rotor_.matrices(w)).at(rootAt(there, w))).solve(right);
  };
  const auto gap = [&](double there, double w) { return 1.0 / u.dot(solved(there, w, v)); };
  const double dx = kDifference * (r.right - r.left), dw = kDifference * (r.high - r.low);
  double last = kInfinity;
  for (int step = 0;; ++step) {
    const Complex now = gap(x, speed);
    const Complex by_x = (gap(x + dx, speed) - gap(x - dx, speed)) / (2.0 * dx);
    const Complex by_w = (gap(x, speed + dw) - gap(x, speed - dw)) / (2.0 * dw);
    const double area = (std::conj(by_x) * by_w).imag();
    const double change_x = (std::conj(by_w) * now).imag() / area;
    const double change_w = -(std::conj(by_x) * now).imag() / area;
    const double change = std::fabs(change_x) + std::fabs(change_w) / speed;
    if (step == kNewtonSteps || !std::isfinite(change)) {
      return std::nullopt;
    }
    x += change_x;
    speed += change_w;
    if (!(x >= 2.0 * r.left - r.right && x <= 2.0 * r.right - r.left &&
          speed >= 2.0 * r.low - r.high && speed <= 2.0 * r.high - r.low && speed > 0.0)) {
      return std::nullopt;
    }
    if (change <= 1.0e-14 || (change <= kSame && change > 0.5 * last)) {
      break;
    }
    last = change;
  }
  if (x < r.left || x > r.right || speed < r.low || speed > r.high) {
    return std::nullopt;
  }
  const double decay = ratioOf(x);
  const Complex s = rootAt(x, speed);
  const VectorXcd shape = solved(x, speed, solved(x, speed, v).normalized()).normalized();
  FoundCrossing found;
  found.at = {speed, decay, slows};
  found.mode.eigenvalue = s;
  found.mode.shape = shape;
  const BandedLinearization l = rotor_.matrices(speed);
  if (std::fabs(s.real()) <= kDoubtfulRealPart * std::abs(s) && unstableRootBound(l) == 0.0) {
    const double by_energy = decayByEnergy(l, {s, shape});
    found.mode.eigenvalue = {by_energy > kNoDamping * std::abs(s) ? -by_energy : 0.0, s.imag()};
  }
  normalise(found.mode, stations_);
  return found;
}

/// Those of one speed, that only their directions distinguish.
void CrossingSearch::addRepeated(const Rectangle& r, bool slows, Search& search) const {
  const double speed = 0.5 * (r.low + r.high);
  const double met = harmonic_ * speed;
  for (const WhirlMode& mode : modesBelow((1.0 + 2.0 * kMet) * met, speed).modes) {
    const double x = std::asinh(-mode.eigenvalue.real() / met);
    if (std::fabs(mode.dampedFrequency() - met) <= kMet * met && x >= r.left && x <= r.right) {
      search.found.push_back({{speed, ratioOf(x), slows}, mode});
    }
  }
}

/// Of those of lowest frequency, all below one [rad/s] at least.
WhirlModes CrossingSearch::modesBelow(double frequency, double speed) const {
  const BandedLinearization l = rotor_.matrices(speed);
  if (l.size() > kMaxCompleteCoordinates) {
    for (std::size_t count = 16; 2 * count < static_cast<std::size_t>(l.size()); count *= 2) {
      auto lowest = lowestWhirlModes(l, stations_, count);
      if (!lowest) {
        break;
      }
      if (!lowest->modes.empty() && lowest->modes.back().dampedFrequency() > frequency) {
        return std::move(*lowest);
      }
    }
  }
  return whirlModes({l.mass.dense(), l.damping.dense(), l.gyroscopic.dense(), l.stiffness.dense(),
                     l.circulatory.dense()},
                    stations_);
}

std::vector<FoundCrossing> CrossingSearch::missing(const std::vector<MetSpeed>& known, double low,
                                                   double high) const {
  Search search{known, {}};
  for (std::size_t band = 0; band + 1 < kBands.size(); ++band) {
    look({kBands[band], kBands[band + 1], low, high}, 0, search);
  }
  return search.found;
}

}  // namespace whirl_twin

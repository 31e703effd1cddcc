#include "analysis/lowest_roots.h"

#include <algorithm>
#include <cmath>
#include <complex>
#include <type_traits>
#include <utility>
#include <vector>

#include "algebra/banded_matrix.h"
#include "algebra/constants.h"
#include "analysis/krylov_space.h"
#include "analysis/refined_eigenvalues.h"

namespace whirl_twin {

namespace {

// How often the phase of det(A0 + s A1 + s^2 A2), divided by the product of s - s_i, goes round
// while s runs along a circle: as often as it has more roots within than there are s_i (the
// argument principle).

/// Of a pencil, that outlives it, along |s| = `radius`.
template <class Scalar>
class DeterminantWinding {
 public:
  DeterminantWinding(const BandedPencil<Scalar>& pencil, double radius,
                     std::vector<std::complex<double>> divided)
      : pencil_(pencil), radius_(radius), divided_(std::move(divided)) {}

  /// By how much it turns from one angle to another [rad]; NaN where it cannot be followed.
  double turn(double from, double to, int pieces) const {
    double sum = 0.0;
    std::complex<double> before = phase(from);
    for (int i = 1; i <= pieces; ++i) {
      const double start = from + (to - from) * (i - 1) / pieces;
      const double end = from + (to - from) * i / pieces;
      const std::complex<double> after = phase(end);
      sum += between(start, end, before, after, 0);
      before = after;
    }
    return sum;
  }

 private:
  static constexpr double kFine = 0.5;  // rad, from point to point
  static constexpr int kMaxRefinements = 12;

  std::complex<double> phase(double angle) const {
    const std::complex<double> s = std::polar(radius_, angle);
    std::complex<double> turned = BandedLU<std::complex<double>>(pencil_.at(s)).determinantPhase();
    for (const std::complex<double>& root : divided_) {
      const std::complex<double> to = s - root;
      turned *= std::conj(to) / std::abs(to);
    }
    return turned;
  }
  double between(double start, double end, const std::complex<double>& before,
                 const std::complex<double>& after, int halvings) const {
    const double turned = std::arg(after * std::conj(before));
    if (std::fabs(turned) <= kFine) {
      return turned;
    }
    if (halvings == kMaxRefinements || std::isnan(turned)) {
      return std::nan("");
    }
    const double middle = 0.5 * (start + end);
    const std::complex<double> there = phase(middle);
    return between(start, middle, before, there, halvings + 1) +
           between(middle, end, there, after, halvings + 1);
  }

  const BandedPencil<Scalar>& pencil_;
  double radius_;
  std::vector<std::complex<double>> divided_;
};

using Complex = std::complex<double>;
using Eigen::Index;
using Eigen::VectorXcd;

constexpr Index kMaxDimensions = 330;
constexpr Index kNarrow = 6;             // widths, of a matrix that is worth it
constexpr double kConverged = 1.0e-8;    // of 1/s: near enough for Newton's method
constexpr double kApart = 1.0e-3;        // of the radius, at least, from root to circle
constexpr std::size_t kMaxMore = 12;     // roots, for a wide gap to lay the circle through
constexpr double kDeflationReach = 4.0;  // radii, of the roots divided out

/// About the lowest root's modulus: by inverse iteration without A1. 0 of a singular A0.
template <class Scalar>
double lowestRate(const BandedPencil<Scalar>& p) {
  const BandedLU<Scalar> inverse(p.a0);
  if (inverse.singular()) {
    return 0.0;
  }
  Eigen::Matrix<Scalar, Eigen::Dynamic, 1> x(p.a0.size());
  for (Index i = 0; i < x.size(); ++i) {
    x[i] = std::cos(1.0 + 2.0 * static_cast<double>(i * i));
  }
  double gain = 0.0;
  for (int step = 0; step < 4; ++step) {
    x.normalize();
    x = inverse.solve(p.a2.times(x));
    gain = x.norm();
  }
  return gain > 0.0 && std::isfinite(gain) ? 1.0 / std::sqrt(gain) : 0.0;
}

/// Of the roots known, those within a circle through a gap between them.
struct Cut {
  std::size_t inside = 0;
  double radius = 0.0;
};

/// Nothing where too few are known.
std::optional<Cut> widestGap(const std::vector<Ritz>& all, std::size_t least, double radius) {
  const std::size_t known = all.size();
  std::size_t first = least;
  while (first < known && std::abs(all[first].root) <= radius) {
    ++first;
  }
  std::optional<Cut> best;
  double widest = 1.0 + 2.0 * kApart;
  for (std::size_t i = first; i < known && i <= first + kMaxMore; ++i) {
    const double below = std::max(radius, i == 0 ? 0.0 : std::abs(all[i - 1].root));
    const double above = std::abs(all[i].root);
    const double ratio = below > 0.0 ? above / below : 2.0;
    if (ratio > widest) {
      widest = ratio;
      best = Cut{i, below > 0.0 ? std::sqrt(above * below) : 0.5 * above};
    }
  }
  return best;
}

/// The polished roots within the cut; nothing if they cannot be all.
template <class Scalar>
std::optional<LowestRoots> confirmed(const ScaledPencil<Scalar>& scaled,
                                     const KrylovSpace<Scalar>& space, const std::vector<Ritz>& all,
                                     const Cut& cut) {
  constexpr bool kReal = std::is_same_v<Scalar, double>;
  LowestRoots found;
  found.radius = cut.radius * scaled.rate;
  std::vector<Complex> divided;
  for (std::size_t i = 0; i < all.size(); ++i) {
    const Complex about = all[i].root;
    if (i >= cut.inside) {
      if (std::abs(about) <= kDeflationReach * cut.radius) {
        divided.push_back(about);
      }
      continue;
    }
    if (kReal && about.imag() < 0.0) {
      continue;  // with the other of its pair
    }
    auto root = polished(scaled.pencil, about, space.shape(all[i]));
    if (!root) {
      return std::nullopt;
    }
    divided.push_back(root->value);
    root->value *= scaled.rate;
    root->shape = scaled.scale.template cast<Complex>().cwiseProduct(root->shape).normalized();
    if (kReal && about.imag() > 0.0) {
      divided.push_back(std::conj(divided.back()));
      found.roots.push_back({std::conj(root->value), root->shape.conjugate()});
    }
    found.roots.push_back(std::move(*root));
  }
  if (found.roots.size() != cut.inside) {
    return std::nullopt;
  }
  const DeterminantWinding<Scalar> winding(scaled.pencil, cut.radius, std::move(divided));
  const double turned = kReal ? winding.turn(0.0, kPi, 12) : winding.turn(-kPi, kPi, 24);
  if (!(std::fabs(turned) < 1.0)) {
    return std::nullopt;
  }
  std::sort(found.roots.begin(), found.roots.end(),
            [](const RefinedEigenpair& a, const RefinedEigenpair& b) {
              const double x = std::abs(a.value);
              const double y = std::abs(b.value);
              return x != y ? x < y : a.value.imag() < b.value.imag();
            });
  return found;
}

/// At least so many roots, and all within the radius.
template <class Scalar>
std::optional<LowestRoots> search(const BandedPencil<Scalar>& pencil, std::size_t count,
                                  double radius) {
  const Index width = std::max({pencil.a0.width(), pencil.a1.width(), pencil.a2.width()});
  if (width * kNarrow > pencil.a0.size()) {
    return std::nullopt;
  }
  const Eigen::VectorXd inertia = unitInertia(pencil);
  const double lowest = lowestRate(inUnits(pencil, inertia, 1.0).pencil);
  if (!(lowest > 0.0)) {
    return std::nullopt;
  }
  const double rate = std::max(radius, 3.0 * lowest);
  const ScaledPencil<Scalar> scaled = inUnits(pencil, inertia, rate);
  KrylovSpace<Scalar> space(scaled.pencil);
  const Index most = std::min(kMaxDimensions, 2 * pencil.a0.size() * 3 / 4);
  for (Index m = 24 + 3 * static_cast<Index>(count) / 2; !space.singular(); m += m / 2) {
    m = std::min(m, most) / kKrylovBlock * kKrylovBlock;
    if (m <= space.dimension()) {
      return std::nullopt;
    }
    space.grow(m);
    // Unconverged and spurious Ritz values are among the others: the check detects a missed root.
    std::vector<Ritz> all = space.ritz();
    all.erase(std::remove_if(all.begin(), all.end(),
                             [](const Ritz& one) { return one.residual > kConverged; }),
              all.end());
    const auto cut = widestGap(all, count, radius / rate);
    if (!cut) {
      continue;
    }
    if (auto found = confirmed(scaled, space, all, *cut)) {
      return found;
    }
  }
  return std::nullopt;
}

}  // namespace

template <class Scalar>
BandedMatrix<Complex> BandedPencil<Scalar>::at(Complex s) const {
  BandedMatrix<Complex> sum(a0.size(), std::max({a0.width(), a1.width(), a2.width()}));
  sum.add(1.0, a0);
  sum.add(s, a1);
  sum.add(s * s, a2);
  return sum;
}

template <class Scalar>
BandedPencil<Scalar> BandedPencil<Scalar>::about(const Scalar& centre) const {
  BandedPencil moved = *this;
  moved.a0.add(centre, a1);
  moved.a0.add(centre * centre, a2);
  moved.a1.add(2.0 * centre, a2);
  return moved;
}

template <class Scalar>
std::optional<LowestRoots> lowestRoots(const BandedPencil<Scalar>& pencil, std::size_t count) {
  return search(pencil, count, 0.0);
}

template <class Scalar>
std::optional<LowestRoots> rootsWithin(const BandedPencil<Scalar>& pencil, double radius) {
  return search(pencil, 0, radius);
}

template struct BandedPencil<double>;
template struct BandedPencil<Complex>;
template std::optional<LowestRoots> lowestRoots(const BandedPencil<double>&, std::size_t);
template std::optional<LowestRoots> lowestRoots(const BandedPencil<Complex>&, std::size_t);
template std::optional<LowestRoots> rootsWithin(const BandedPencil<double>&, double);
template std::optional<LowestRoots> rootsWithin(const BandedPencil<Complex>&, double);

}  // namespace whirl_twin

#include "analysis/lowest_eigenvalues.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "analysis/unstable_root_bound.h"

namespace whirl_twin {

namespace {

using Complex = std::complex<double>;

constexpr double kRealPartRounding = 1.0e-13;  // of s: a real part that is none
constexpr double kFarther = 8.0;               // radii, search range of the proof

/// The roots found, and further ones where the proof that no other grows requires them.
std::optional<LowestRoots> asFarAsProved(std::optional<LowestRoots> found,
                                         const BandedPencil<double>& pencil,
                                         const std::optional<double>& growth_radius) {
  if (found && growth_radius && *growth_radius > found->radius &&
      *growth_radius < kFarther * found->radius) {
    if (auto more = rootsWithin(pencil, *growth_radius)) {
      return more;
    }
  }
  return found;
}

/// The eigenvalues of the roots found, before selection. Small real parts are computed from the
/// energy.
LowestEigenvalues valuesOf(const LowestRoots& found, const BandedLinearization& l,
                           const std::optional<double>& growth_radius) {
  LowestEigenvalues lowest;
  lowest.omitted_are_sure = growth_radius && *growth_radius <= found.radius;
  lowest.undamped = growth_radius == 0.0 && l.damping.isZero();
  // What is fed and what is dissipated differ by no less than their rounding; alone, the latter has
  // none but that of a shape, squared.
  const double none = growth_radius == 0.0 ? kNoDamping : kRealPartRounding;
  for (const RefinedEigenpair& root : found.roots) {
    Complex s = root.value;
    if (lowest.undamped) {
      s = {0.0, s.imag()};
    } else if (std::fabs(s.real()) <= kDoubtfulRealPart * std::abs(s)) {
      const double decay = decayByEnergy(l, root);
      s = {std::fabs(decay) > none * std::abs(s) ? -decay : 0.0, s.imag()};
    }
    lowest.roots.push_back(s);
  }
  return lowest;
}

/// Drops those after the first `count`, except those that grow.
LowestEigenvalues tell(LowestEigenvalues lowest, std::size_t count, Eigen::Index size) {
  for (std::size_t i = lowest.roots.size(); i > count && lowest.roots[i - 1].real() <= 0.0; --i) {
    lowest.roots.pop_back();
  }
  lowest.omitted = 2 * static_cast<std::size_t>(size) - lowest.roots.size();
  return lowest;
}

}  // namespace

BandedPencil<double> pencilOf(const BandedLinearization& l) {
  return {l.byPlace(), l.byRate(), l.mass};
}

double decayByEnergy(const BandedLinearization& l, const RefinedEigenpair& root) {
  const auto form = [&](const BandedMatrix<double>& m) {
    return root.shape.dot(m.times(root.shape).col(0));
  };
  const double squared = std::norm(root.value);
  return (form(l.damping).real() * squared + root.value.imag() * form(l.circulatory).imag()) /
         (form(l.mass).real() * squared + std::max(0.0, form(l.stiffness).real()));
}

std::optional<LowestEigenvalues> lowestEigenvalues(const BandedLinearization& l,
                                                   std::size_t modes) {
  const std::optional<double> growth_radius = unstableRootBound(l);
  const BandedPencil<double> pencil = pencilOf(l);
  const auto found = asFarAsProved(lowestRoots(pencil, 2 * modes), pencil, growth_radius);
  if (!found) {
    return std::nullopt;
  }
  LowestEigenvalues lowest = valuesOf(*found, l, growth_radius);
  std::size_t count = 2 * modes;
  if (count > 0 && count < lowest.roots.size() && lowest.roots[count].imag() != 0.0 &&
      lowest.roots[count] == std::conj(lowest.roots[count - 1])) {
    ++count;  // the other of a pair
  }
  return tell(std::move(lowest), count, l.size());
}

std::optional<LowestEigenvalues> eigenvaluesWithin(const BandedLinearization& l, double radius) {
  const std::optional<double> growth_radius = unstableRootBound(l);
  const BandedPencil<double> pencil = pencilOf(l);
  const auto found = asFarAsProved(rootsWithin(pencil, radius), pencil, growth_radius);
  if (!found) {
    return std::nullopt;
  }
  LowestEigenvalues lowest = valuesOf(*found, l, growth_radius);
  const auto count = std::count_if(lowest.roots.begin(), lowest.roots.end(),
                                   [&](const Complex& s) { return std::abs(s) <= radius; });
  return tell(std::move(lowest), static_cast<std::size_t>(count), l.size());
}

}  // namespace whirl_twin

#include "analysis/lowest_eigenvalues.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "analysis/growth_radius.h"

namespace whirl_twin {

namespace {

using Complex = std::complex<double>;

constexpr double kDoubtful = 1.0e-8;   // of s: a real part that the energy tells
constexpr double kRounding = 1.0e-13;  // of s: a real part that is none
constexpr double kNoDamping = 1.0e-18;
constexpr double kFarther = 8.0;  // radii, that are looked at for the sake of a proof

/// Those found, and more where the proof wants them.
std::optional<LowestRoots> rootsFor(const BandedPencil<double>& pencil, std::size_t modes,
                                    const std::optional<double>& growth_radius) {
  auto found = lowestRoots(pencil, 2 * modes);
  if (found && growth_radius && *growth_radius > found->radius &&
      *growth_radius < kFarther * found->radius) {
    if (auto more = rootsWithin(pencil, *growth_radius)) {
      return more;
    }
  }
  return found;
}

}  // namespace

BandedPencil<double> pencilOf(const BandedLinearization& l) {
  return {l.byPlace(), l.byRate(), l.mass};
}

double decayByEnergy(const BandedLinearization& l, const PencilRoot& root) {
  const auto form = [&](const BandedMatrix<double>& m) {
    return root.shape.dot(m.times(root.shape).col(0));
  };
  const double squared = std::norm(root.value);
  return (form(l.damping).real() * squared + root.value.imag() * form(l.circulatory).imag()) /
         (form(l.mass).real() * squared + std::max(0.0, form(l.stiffness).real()));
}

std::optional<LowestEigenvalues> lowestEigenvalues(const BandedLinearization& l,
                                                   std::size_t modes) {
  const std::optional<double> growth_radius = growthRadius(l);
  const std::optional<LowestRoots> found = rootsFor(pencilOf(l), modes, growth_radius);
  if (!found) {
    return std::nullopt;
  }
  LowestEigenvalues lowest;
  lowest.omitted_are_sure = growth_radius && *growth_radius <= found->radius;
  lowest.undamped = growth_radius == 0.0 && l.damping.isZero();
  // What is fed and what is dissipated differ by no less than their rounding; alone, the latter has
  // none but that of a shape, squared.
  const double none = growth_radius == 0.0 ? kNoDamping : kRounding;
  std::size_t told = 0;
  for (const PencilRoot& root : found->roots) {
    Complex s = root.value;
    if (lowest.undamped) {
      s = {0.0, s.imag()};
    } else if (std::fabs(s.real()) <= kDoubtful * std::abs(s)) {
      const double decay = decayByEnergy(l, root);
      s = {std::fabs(decay) > none * std::abs(s) ? -decay : 0.0, s.imag()};
    }
    lowest.roots.push_back(s);
    const std::size_t count = lowest.roots.size();
    const bool other_of_pair =
        count == 2 * modes + 1 && s.imag() != 0.0 && s == std::conj(lowest.roots[count - 2]);
    if (count <= 2 * modes || other_of_pair || s.real() > 0.0) {
      told = count;
    }
  }
  lowest.roots.resize(told);
  lowest.omitted = 2 * static_cast<std::size_t>(l.size()) - told;
  return lowest;
}

}  // namespace whirl_twin

#include "analysis/mode_continuation.h"

#include <cmath>

#include "analysis/lowest_eigenvalues.h"

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

}  // namespace whirl_twin

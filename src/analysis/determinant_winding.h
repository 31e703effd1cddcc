// How often the phase of det(A0 + s A1 + s^2 A2), divided by the product of s - s_i, goes round
// while s runs along a circle: as often as it has more roots within than there are s_i (the
// argument principle).
#pragma once

#include <cmath>
#include <complex>
#include <utility>
#include <vector>

#include "algebra/banded_matrix.h"
#include "analysis/lowest_roots.h"

namespace whirl_twin {

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
  static constexpr int kMostHalvings = 12;

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
    if (halvings == kMostHalvings || std::isnan(turned)) {
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

}  // namespace whirl_twin

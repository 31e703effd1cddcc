// Refinement of eigenvalues that the dense solution computes inaccurately. Its error is relative to
// the largest of them: together with stiff or strongly damped roots of 1e6 1/s and more, a whirl of
// 40 rad/s has 9 digits.
#pragma once

#include <Eigen/Core>
#include <algorithm>
#include <cmath>
#include <complex>
#include <optional>
#include <vector>

#include "analysis/lowest_roots.h"
#include "mechanics/linearization.h"

namespace whirl_twin {

// How far the eigenvalues of a reduced rotor are from those of the full one, without all of those.

/// Largest |s_full - s_reduced| / |s_full| over the eigenvalues with |s| <= largest [1/s] of the
/// rotor reduced to `shapes` [dof x n]. Each is followed to its own of the full rotor by Newton's
/// method on (s^2 M + s (C + G) + K + N) v = 0, c^H v = 1.
double largestEigenvalueError(const Linearization& full, const Linearization& reduced,
                              const Eigen::MatrixXd& shapes, double largest);

/// Of M q'' + (C + G) q' + (K + N) q = 0: each of `eigenvalues` [1/s], in complete pairs, with a
/// possible error above some 1e-10 of its modulus is refined by Newton's method on these matrices;
/// it is unchanged where that converges to a different root. `norm`: of the state matrix of the
/// eigensolution [1/s].
void refineEigenvalues(const Linearization& linearization, double norm,
                       std::vector<std::complex<double>>& eigenvalues);

// A root of A0 + s A1 + s^2 A2 that is nearly one, to the last digit that the entries have.

/// A pencil in other units of its coordinates and of s.
template <class Scalar>
struct ScaledPencil {
  BandedPencil<Scalar> pencil;
  Eigen::VectorXd scale;
  double rate = 1.0;
};

template <class Scalar>
ScaledPencil<Scalar> inUnits(const BandedPencil<Scalar>& p, const Eigen::VectorXd& scale,
                             double rate) {
  ScaledPencil<Scalar> s{{p.a0.scaled(scale), BandedMatrix<Scalar>(p.a0.size(), 0),
                          BandedMatrix<Scalar>(p.a0.size(), 0)},
                         scale,
                         rate};
  s.pencil.a1.add(rate, p.a1.scaled(scale));
  s.pencil.a2.add(rate * rate, p.a2.scaled(scale));
  return s;
}

/// Coordinates of unit inertia.
template <class Scalar>
Eigen::VectorXd unitInertia(const BandedPencil<Scalar>& p) {
  const Eigen::ArrayXd diagonal = p.a2.diagonal().array().abs();
  return (diagonal > 0.0).select(diagonal.max(1e-300).rsqrt(), 1.0);
}

/// (A0 + s A1 + s^2 A2) x, its cancellation in more digits than those of the entries: the lowest
/// roots of a fine shaft are small beside its entries.
template <class Scalar>
Eigen::VectorXcd pencilResidual(const BandedPencil<Scalar>& p, const std::complex<double>& s,
                                const Eigen::VectorXcd& x) {
  using LongComplex = std::complex<long double>;
  const LongComplex rate(s.real(), s.imag());
  const LongComplex squared(rate.real() * rate.real() - rate.imag() * rate.imag(),
                            2.0L * rate.real() * rate.imag());
  const Eigen::Index n = x.size();
  std::vector<LongComplex> sum(static_cast<std::size_t>(n));
  const auto addTo = [](LongComplex& to, const LongComplex& a, const LongComplex& b) {
    to += LongComplex(a.real() * b.real() - a.imag() * b.imag(),
                      a.real() * b.imag() + a.imag() * b.real());
  };
  for (Eigen::Index j = 0; j < n; ++j) {
    const LongComplex at(x[j].real(), x[j].imag());
    LongComplex by_rate = 0.0L;
    LongComplex by_square = 0.0L;
    addTo(by_rate, rate, at);
    addTo(by_square, squared, at);
    const auto part = [&](const BandedMatrix<Scalar>& m, const LongComplex& by) {
      const Eigen::Index last = std::min(n - 1, j + m.width());
      for (Eigen::Index i = std::max<Eigen::Index>(0, j - m.width()); i <= last; ++i) {
        const std::complex<double> entry = m(i, j);
        addTo(sum[static_cast<std::size_t>(i)], LongComplex(entry.real(), entry.imag()), by);
      }
    };
    part(p.a0, at);
    part(p.a1, by_rate);
    part(p.a2, by_square);
  }
  Eigen::VectorXcd rounded(n);
  for (Eigen::Index i = 0; i < n; ++i) {
    const LongComplex& of = sum[static_cast<std::size_t>(i)];
    rounded[i] = {static_cast<double>(of.real()), static_cast<double>(of.imag())};
  }
  return rounded;
}

/// Newton's method (mode_tracking.h) from an approximate root, ended by two steps from the residual
/// of the equation. Nothing if it diverges from the root.
template <class Scalar>
std::optional<RefinedEigenpair> polished(const BandedPencil<Scalar>& p,
                                         const std::complex<double>& from,
                                         const Eigen::VectorXcd& shape) {
  constexpr double kMoved = 1.0e-5;     // of s: it would be another root
  constexpr double kSettled = 1.0e-14;  // of s
  constexpr int kMaxSteps = 4;
  std::complex<double> s = from;
  Eigen::VectorXcd x = shape;
  double last = kMoved * std::abs(s);
  for (int step = 0; step < kMaxSteps; ++step) {
    const Eigen::VectorXcd slope = p.a1.times(x) + 2.0 * s * p.a2.times(x);
    const BandedLU<std::complex<double>> lu(p.at(s));
    if (lu.singular()) {
      break;  // there to the last digit
    }
    const Eigen::VectorXcd y = lu.solve(slope);
    const std::complex<double> change = 1.0 / x.dot(y);
    const double size = std::abs(change);
    if (!std::isfinite(size) || !(std::abs(s - change - from) <= kMoved * std::abs(from))) {
      return std::nullopt;
    }
    if (step > 0 && size > 0.5 * last) {
      break;  // rounding lets it come no nearer
    }
    s -= change;
    x = y.normalized();
    if (size <= kSettled * std::abs(s)) {
      break;
    }
    last = size;
  }
  for (int step = 0; step < 2; ++step) {
    const Eigen::VectorXcd slope = p.a1.times(x) + 2.0 * s * p.a2.times(x);
    Eigen::MatrixXcd sides(x.size(), 2);
    sides << pencilResidual(p, s, x), slope;
    const BandedLU<std::complex<double>> lu(p.at(s));
    if (lu.singular()) {
      break;
    }
    const Eigen::MatrixXcd y = lu.solve(sides);
    const std::complex<double> change = x.dot(y.col(0)) / x.dot(y.col(1));
    if (!(std::abs(s - change - from) <= kMoved * std::abs(from))) {
      return std::nullopt;
    }
    s -= change;
    x = (x - y.col(0) + change * y.col(1)).normalized();
  }
  return RefinedEigenpair{s, x};
}

}  // namespace whirl_twin

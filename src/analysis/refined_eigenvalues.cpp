#include "analysis/refined_eigenvalues.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "analysis/lowest_eigenvalues.h"
#include "analysis/polished_root.h"

namespace whirl_twin {

namespace {

using Complex = std::complex<double>;

/// Of its modulus, that an eigenvalue may be off by the rounding of the matrix; shapes that are far
/// from orthogonal make a hundred times as much of it.
constexpr double kEnough = 3.0e-12;
constexpr int kInverseSteps = 2;

/// The shape next to s, by inverse iteration; empty where s is a root to the last digit.
Eigen::VectorXcd shapeNear(const BandedPencil<double>& pencil, const Complex& s) {
  const BandedLU<Complex> inverse(pencil.at(s));
  if (inverse.singular()) {
    return {};
  }
  Eigen::VectorXcd x(pencil.a0.size());
  for (Eigen::Index i = 0; i < x.size(); ++i) {
    x[i] = std::cos(1.0 + 2.0 * static_cast<double>(i * i));
  }
  for (int step = 0; step < kInverseSteps; ++step) {
    x = inverse.solve(x).col(0);
    x.normalize();
  }
  return x;
}

}  // namespace

void refineEigenvalues(const Linearization& l, double norm, std::vector<Complex>& eigenvalues) {
  const double error = std::numeric_limits<double>::epsilon() * norm;
  const auto doubtful = [&](const Complex& s) {
    return s.imag() >= 0.0 && std::abs(s) > error && error > kEnough * std::abs(s);
  };
  if (std::none_of(eigenvalues.begin(), eigenvalues.end(), doubtful)) {
    return;
  }
  const BandedPencil<double> pencil = pencilOf(banded(l));
  const Eigen::VectorXd inertia = unitInertia(pencil);
  for (Complex& s : eigenvalues) {
    if (!doubtful(s)) {
      continue;
    }
    const ScaledPencil<double> scaled = inUnits(pencil, inertia, std::abs(s));
    const Complex unit = s / std::abs(s);
    const Eigen::VectorXcd shape = shapeNear(scaled.pencil, unit);
    const auto root =
        shape.allFinite() && shape.size() > 0 ? polished(scaled.pencil, unit, shape) : std::nullopt;
    if (!root) {
      continue;
    }
    const Complex refined = root->value * std::abs(s);
    const auto other = std::find(eigenvalues.begin(), eigenvalues.end(), std::conj(s));
    if (s.imag() > 0.0 && other != eigenvalues.end()) {
      *other = std::conj(refined);
    }
    s = s.imag() > 0.0 ? refined : Complex(refined.real(), 0.0);
  }
}

}  // namespace whirl_twin

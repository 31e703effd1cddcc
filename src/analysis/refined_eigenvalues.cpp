#include "analysis/refined_eigenvalues.h"

#include <algorithm>
#include <cmath>
#include <complex>
#include <limits>

#include "algebra/constants.h"
#include "algebra/dense.h"
#include "algebra/sparse_solver.h"
#include "analysis/lowest_eigenvalues.h"

namespace whirl_twin {

namespace {

using Complex = std::complex<double>;
using Eigen::Index;
using Eigen::MatrixXcd;
using Eigen::MatrixXd;
using Eigen::VectorXcd;

constexpr int kMaxRefinementSteps = 12;
constexpr double kRefinementTolerance = 1.0e-13;

/// State matrix of (q, q' / scale): its entries are of one size.
MatrixXd scaledStateMatrix(const Linearization& l, double scale) {
  const Index n = l.mass.rows();
  const Cholesky mass(l.mass);
  MatrixXd state = MatrixXd::Zero(2 * n, 2 * n);
  state.topRightCorner(n, n).diagonal().setConstant(scale);
  state.bottomLeftCorner(n, n) = -mass.solve(l.stiffness + l.circulatory) / scale;
  state.bottomRightCorner(n, n) = -mass.solve(l.damping + l.gyroscopic);
  return state;
}

/// The full rotor's eigenvalue next to s, whose shape is about v; not finite if there is none.
Complex refinedEigenvalue(const Linearization& l, Complex s, VectorXcd v) {
  const Index n = v.size();
  v.normalize();
  const VectorXcd border = v;
  SparseSolver solver;
  for (int step = 0; step < kMaxRefinementSteps; ++step) {
    MatrixXcd newton = MatrixXcd::Zero(n + 1, n + 1);
    newton.topLeftCorner(n, n) =
        s * s * l.mass + s * (l.damping + l.gyroscopic) + l.stiffness + l.circulatory;
    newton.topRightCorner(n, 1) = (2.0 * s * l.mass + l.damping + l.gyroscopic) * v;
    newton.bottomLeftCorner(1, n) = border.adjoint();
    VectorXcd residual(n + 1);
    residual << newton.topLeftCorner(n, n) * v, Complex(0.0);
    const VectorXcd change = solver.solve(newton.sparseView(), residual);
    if (!change.allFinite()) {
      return Complex(kNaN, 0.0);
    }
    v -= change.head(n);
    s -= change[n];
    if (std::abs(change[n]) <= kRefinementTolerance * std::abs(s)) {
      break;
    }
  }
  return s;
}

}  // namespace

double largestEigenvalueError(const Linearization& full, const Linearization& reduced,
                              const MatrixXd& shapes, double largest) {
  const EigenPairs solver = eigenPairs(scaledStateMatrix(reduced, largest));
  const Index n = shapes.cols();
  double worst = 0.0;
  for (Index i = 0; i < 2 * n; ++i) {
    const Complex s = solver.values[i];
    // One of each pair; rigid-body motions are exact.
    if (std::abs(s) > largest || s.imag() < 0.0 || std::abs(s) < 1.0e-6 * largest) {
      continue;
    }
    const Complex exact = refinedEigenvalue(full, s, shapes * solver.vectors.col(i).head(n));
    const double error = std::abs(exact - s) / std::abs(exact);
    worst = std::isfinite(error) ? std::max(worst, error) : worst;
  }
  return worst;
}

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

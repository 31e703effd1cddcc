#include "analysis/eigenvalue_refinement.h"

#include <algorithm>
#include <cmath>
#include <complex>

#include "algebra/constants.h"
#include "algebra/dense.h"
#include "algebra/sparse_solver.h"

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

}  // namespace whirl_twin

#include "analysis/flexibility_form.h"

#include <cmath>
#include <complex>
#include <limits>
#include <vector>

#include "algebra/dense.h"

namespace whirl_twin {

namespace {

using Complex = std::complex<double>;
using Eigen::Index;
using Eigen::MatrixXcd;
using Eigen::MatrixXd;
using Eigen::VectorXcd;

constexpr double kCancelled = 1.0e-8;  // reciprocal condition of I + N'

/// The finite of 1 / mu, and their shapes.
FlexibilityPairs pairsOf(const VectorXcd& inverse, const MatrixXcd& states, const Cholesky& root) {
  const Index n = root.lower().rows();
  const double largest = inverse.cwiseAbs().maxCoeff();
  FlexibilityPairs found;
  found.error =
      static_cast<double>(inverse.size()) * std::numeric_limits<double>::epsilon() * largest;
  std::vector<Index> finite;
  for (Index i = 0; i < inverse.size(); ++i) {
    if (std::abs(inverse[i]) > found.error) {
      finite.push_back(i);
    }
  }
  const MatrixXcd y = states(Eigen::seqN(0, n), finite);
  found.shapes.resize(y.rows(), y.cols());
  found.shapes.real() = root.solveUpper(MatrixXd(y.real()));
  found.shapes.imag() = root.solveUpper(MatrixXd(y.imag()));
  found.values = VectorXcd(inverse(finite)).cwiseInverse();
  return found;
}

}  // namespace

MatrixXd inertiaFactor(const MatrixXd& mass) {
  std::vector<Index> heavy;
  for (Index i = 0; i < mass.rows(); ++i) {
    if (!mass.row(i).isZero(0.0)) {
      heavy.push_back(i);
    }
  }
  const Cholesky factor{MatrixXd(mass(heavy, heavy))};
  if (heavy.empty() || !factor.succeeded()) {
    return MatrixXd::Zero(mass.rows(), 0);
  }
  MatrixXd root = MatrixXd::Zero(mass.rows(), static_cast<Index>(heavy.size()));
  root(heavy, Eigen::all) = factor.lower();
  return root;
}

std::optional<FlexibilityPairs> flexibilityPairs(const Linearization& l) {
  const Cholesky root(l.stiffness);
  const MatrixXd inertia = inertiaFactor(l.mass);
  if (!root.succeeded() || inertia.cols() == 0) {
    return std::nullopt;
  }
  const Index n = l.mass.rows();
  const Index size = n + inertia.cols();
  const auto inUnits = [&](const MatrixXd& m) -> MatrixXd {
    return root.solveLower(MatrixXd(root.solveLower(m).transpose())).transpose();
  };
  const MatrixXd half = root.solveLower(inertia);
  MatrixXd b = MatrixXd::Zero(size, size);
  b.bottomLeftCorner(size - n, n) = half.transpose();
  b.topRightCorner(n, size - n) = -half;
  if (l.damping.isZero(0.0) && l.circulatory.isZero(0.0)) {
    const MatrixXd gyroscopic = inUnits(l.gyroscopic);
    b.topLeftCorner(n, n) = -0.5 * (gyroscopic - gyroscopic.transpose());
    const auto solver = hermitianModes(Complex(0.0, -1.0) * b.cast<Complex>());
    if (!solver.succeeded) {
      return std::nullopt;
    }
    return pairsOf(Complex(0.0, 1.0) * solver.values.cast<Complex>(), solver.vectors, root);
  }
  b.topLeftCorner(n, n) = -inUnits(l.damping + l.gyroscopic);
  if (!l.circulatory.isZero(0.0)) {
    const Lu place(MatrixXd::Identity(n, n) + inUnits(l.circulatory));
    if (!(place.rcond() > kCancelled)) {
      return std::nullopt;
    }
    b.topRows(n) = place.solve(b.topRows(n));
  }
  const EigenPairs solver = eigenPairs(b);
  if (!solver.succeeded) {
    return std::nullopt;
  }
  return pairsOf(solver.values, solver.vectors, root);
}

}  // namespace whirl_twin

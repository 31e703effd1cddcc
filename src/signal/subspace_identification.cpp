#include "signal/subspace_identification.h"

#include <algorithm>
#include <cmath>

#include "algebra/dense.h"

namespace whirl_twin {

namespace {

/// Of the largest singular value, below which there is no mode but rounding.
constexpr double kMinSingular = 1.0e-9;

/// The shape with its largest part 1.
Eigen::VectorXcd normalised(const Eigen::VectorXcd& shape) {
  Eigen::Index largest = 0;
  shape.cwiseAbs().maxCoeff(&largest);
  return shape / shape[largest];
}

}  // namespace

SubspaceIdentification::SubspaceIdentification(const std::vector<Eigen::MatrixXcd>& covariance,
                                               double spacing, int first_lag)
    : spacing_(spacing),
      first_lag_(first_lag),
      stations_(covariance.front().rows()),
      traces_(static_cast<Eigen::Index>(covariance.size())) {
  const auto n = static_cast<Eigen::Index>((covariance.size() + 1) / 2);
  Eigen::MatrixXcd hankel(n * stations_, n * stations_);
  for (Eigen::Index i = 0; i < n; ++i) {
    for (Eigen::Index j = 0; j < n; ++j) {
      hankel.block(i * stations_, j * stations_, stations_, stations_) =
          covariance[static_cast<std::size_t>(i + j)];
    }
  }
  for (Eigen::Index k = 0; k < traces_.size(); ++k) {
    traces_[k] = covariance[static_cast<std::size_t>(k)].trace();
  }
  if (!hankel.allFinite() || hankel.isZero(0.0)) {
    return;
  }
  const ComplexLeftSingularVectors svd = complexLeftSingularVectors(hankel);
  singular_ = svd.values;
  left_ = svd.u;
}

std::vector<IdentifiedMode> SubspaceIdentification::modes(int order) const {
  if (left_.size() == 0) {
    return {};
  }
  const Eigen::Index shifted = left_.rows() - stations_;
  Eigen::Index modes = std::min<Eigen::Index>(order, shifted);
  while (modes > 1 && singular_[modes - 1] < kMinSingular * singular_[0]) {
    --modes;
  }
  const Eigen::MatrixXcd observability =
      left_.leftCols(modes) * singular_.head(modes).cwiseSqrt().asDiagonal();
  const Eigen::MatrixXcd shift =
      leastSquares(observability.topRows(shifted), observability.bottomRows(shifted));
  const EigenPairs eigen = eigenPairs(shift);
  const Eigen::VectorXcd poles = eigen.values;
  const Eigen::MatrixXcd shapes = observability.topRows(stations_) * eigen.vectors;

  // tr R_k = sum p_m pole_m^k, for how much of the motion each is.
  Eigen::MatrixXcd powers(traces_.size(), modes);
  for (Eigen::Index m = 0; m < modes; ++m) {
    powers(0, m) = std::pow(poles[m], first_lag_ - 1);
    for (Eigen::Index k = 0; k < powers.rows(); ++k) {
      powers(k, m) = (k == 0 ? powers(0, m) : powers(k - 1, m)) * poles[m];
    }
  }
  const Eigen::VectorXcd part = leastSquares(powers, traces_);

  std::vector<IdentifiedMode> found;
  for (Eigen::Index m = 0; m < modes; ++m) {
    const std::complex<double> exponent = std::log(poles[m]) / spacing_;
    if (std::isfinite(exponent.real()) && shapes.col(m).allFinite()) {
      found.push_back(
          {exponent.imag(), -exponent.real(), std::abs(part[m]), normalised(shapes.col(m))});
    }
  }
  std::sort(found.begin(), found.end(),
            [](const auto& a, const auto& b) { return a.power > b.power; });
  return found;
}

std::vector<IdentifiedMode> identifyModes(const std::vector<std::complex<double>>& covariance,
                                          double spacing, int order) {
  std::vector<Eigen::MatrixXcd> matrices;
  for (const std::complex<double>& c : covariance) {
    matrices.push_back(Eigen::MatrixXcd::Constant(1, 1, c));
  }
  return SubspaceIdentification(matrices, spacing).modes(order);
}

}  // namespace whirl_twin

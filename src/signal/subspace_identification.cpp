#include "signal/subspace_identification.h"

#include <algorithm>
#include <cmath>

#include "algebra/eigenvalues.h"
#include "algebra/qr.h"
#include "algebra/svd.h"

namespace whirl_twin {

namespace {

/// Of the largest singular value, below which there is no mode but rounding.
constexpr double kSmallestSingular = 1.0e-9;

}  // namespace

std::vector<IdentifiedMode> identifyModes(const std::vector<std::complex<double>>& covariance,
                                          double spacing, int order) {
  const auto n = static_cast<Eigen::Index>((covariance.size() + 1) / 2);
  Eigen::MatrixXcd hankel(n, n);
  for (Eigen::Index i = 0; i < n; ++i) {
    for (Eigen::Index j = 0; j < n; ++j) {
      hankel(i, j) = covariance[static_cast<std::size_t>(i + j)];
    }
  }
  if (!hankel.allFinite() || hankel.isZero(0.0)) {
    return {};
  }
  const Eigen::JacobiSVD<Eigen::MatrixXcd> svd(hankel, Eigen::ComputeThinU);
  const Eigen::VectorXd& singular = svd.singularValues();
  Eigen::Index modes = std::min<Eigen::Index>(order, n - 1);
  while (modes > 1 && singular[modes - 1] < kSmallestSingular * singular[0]) {
    --modes;
  }
  const Eigen::MatrixXcd observability =
      svd.matrixU().leftCols(modes) * singular.head(modes).cwiseSqrt().asDiagonal();
  const Eigen::MatrixXcd shift =
      observability.topRows(n - 1).householderQr().solve(observability.bottomRows(n - 1));
  const Eigen::VectorXcd poles =
      Eigen::ComplexEigenSolver<Eigen::MatrixXcd>(shift, false).eigenvalues();

  // c_k = sum p_m pole_m^k, for how much of the motion each is.
  Eigen::MatrixXcd powers(static_cast<Eigen::Index>(covariance.size()), modes);
  for (Eigen::Index k = 0; k < powers.rows(); ++k) {
    for (Eigen::Index m = 0; m < modes; ++m) {
      powers(k, m) = k == 0 ? poles[m] : powers(k - 1, m) * poles[m];
    }
  }
  const Eigen::VectorXcd part = powers.colPivHouseholderQr().solve(
      Eigen::Map<const Eigen::VectorXcd>(covariance.data(), powers.rows()));

  std::vector<IdentifiedMode> found;
  for (Eigen::Index m = 0; m < modes; ++m) {
    const std::complex<double> exponent = std::log(poles[m]) / spacing;
    if (std::isfinite(exponent.real())) {
      found.push_back({exponent.imag(), -exponent.real(), std::abs(part[m])});
    }
  }
  std::sort(found.begin(), found.end(),
            [](const auto& a, const auto& b) { return a.power > b.power; });
  return found;
}

}  // namespace whirl_twin

#include "estimation/information.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "algebra/cholesky.h"
#include "algebra/eigenvalues.h"
#include "algebra/qr.h"

namespace whirl_twin {

namespace {

constexpr double kNaN = std::numeric_limits<double>::quiet_NaN();
/// Of the largest eigenvalue: differences that are good to six digits leave some 1e-12 of what
/// should vanish.
constexpr double kNothing = 1.0e-11;
constexpr double kTakesPart = 0.1;
constexpr double kLeastPart = 1.0e-3;  // of a size: less is rounding

}  // namespace

void NormalEquations::add(const WindowDerivatives& window) {
  if (matrix.size() == 0) {
    matrix = Eigen::MatrixXd::Zero(window.by_unknowns.cols(), window.by_unknowns.cols());
  }
  Eigen::MatrixXd left = window.by_unknowns;
  Eigen::VectorXd rest = window.residuals;
  if (window.by_start.cols() > 0) {
    // What a start cannot make good.
    const Eigen::ColPivHouseholderQR<Eigen::MatrixXd> qr(window.by_start);
    const Eigen::Index rank = qr.rank();
    left = (qr.householderQ().transpose() * left).bottomRows(left.rows() - rank).eval();
    rest = (qr.householderQ().transpose() * rest).tail(rest.size() - rank).eval();
    starts += rank;
  }
  matrix += left.transpose() * left;
  squares += rest.squaredNorm();
  residuals += window.residuals.size();
}

double NormalEquations::variance() const {
  const Eigen::Index free = residuals - starts - matrix.rows();
  return free > 0 ? squares / static_cast<double>(free) : kNaN;
}

bool Information::told(Eigen::Index unknown) const {
  return std::none_of(untold.begin(), untold.end(), [&](const UntoldDirection& direction) {
    return direction.takes_part[static_cast<std::size_t>(unknown)];
  });
}

Information information(const NormalEquations& normal, const Eigen::VectorXd& theta,
                        const Eigen::VectorXd& sizes, double rows_alike) {
  Information result;
  const Eigen::Index n = sizes.size();
  result.deviation = Eigen::VectorXd::Constant(n, kNaN);
  result.correlation = Eigen::MatrixXd::Constant(n, n, kNaN);
  if (n == 0) {
    return result;
  }
  const double variance = normal.variance();
  const Eigen::MatrixXd scaled = sizes.asDiagonal() * normal.matrix * sizes.asDiagonal();
  const Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd> modes(scaled);

  Eigen::MatrixXd known(n, 0);  // directions that are told, in parts
  const auto addKnown = [&](const Eigen::VectorXd& direction) {
    known.conservativeResize(Eigen::NoChange, known.cols() + 1);
    known.col(known.cols() - 1) = direction;
  };
  const double nothing = kNothing * modes.eigenvalues().maxCoeff();
  for (Eigen::Index k = 0; k < n; ++k) {
    const Eigen::VectorXd direction = modes.eigenvectors().col(k);
    const double strength = modes.eigenvalues()[k];
    const double deviation = strength > 0.0 ? std::sqrt(rows_alike * variance / strength)
                                            : std::numeric_limits<double>::infinity();
    Eigen::Index largest = 0;
    direction.cwiseAbs().maxCoeff(&largest);
    if (strength <= nothing || deviation > 1.0) {
      result.untold.push_back({direction / direction[largest], deviation, {}});
    } else {
      addKnown(direction);
    }
  }
  const Eigen::MatrixXd inner = known.transpose() * scaled * known;
  const Eigen::MatrixXd covariance =
      known.cols() == 0 ? Eigen::MatrixXd::Zero(n, n)
                        : Eigen::MatrixXd(variance * known *
                                          inner.ldlt().solve(Eigen::MatrixXd(known.transpose())));
  for (UntoldDirection& direction : result.untold) {
    for (Eigen::Index i = 0; i < n; ++i) {
      const double part = std::fabs(direction.parts[i]);
      const bool of_value =
          part >= kLeastPart && part * sizes[i] >= kTakesPart * std::fabs(theta[i]);
      direction.takes_part.push_back(part >= kTakesPart ||
                                     (of_value && part > std::sqrt(covariance(i, i))));
    }
  }
  for (Eigen::Index i = 0; i < n; ++i) {
    if (result.told(i)) {
      result.deviation[i] = sizes[i] * std::sqrt(covariance(i, i));
    }
    for (Eigen::Index j = 0; j < n; ++j) {
      if (result.told(i) && result.told(j)) {
        result.correlation(i, j) =
            covariance(i, j) / std::sqrt(covariance(i, i) * covariance(j, j));
      }
    }
  }
  return result;
}

}  // namespace whirl_twin

#include "estimation/information.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "algebra/constants.h"
#include "algebra/dense.h"

namespace whirl_twin {

namespace {

/// Relative to the largest eigenvalue: differences with six correct digits leave some 1e-12 where
/// the exact value is 0.
constexpr double kNothing = 1.0e-11;
constexpr double kParticipation = 0.1;
constexpr double kMinPart = 1.0e-3;  // relative to a size: less is rounding

}  // namespace

void NormalEquations::add(const WindowDerivatives& window) {
  if (matrix.size() == 0) {
    matrix = Eigen::MatrixXd::Zero(window.by_unknowns.cols(), window.by_unknowns.cols());
  }
  Eigen::MatrixXd left = window.by_unknowns;
  Eigen::VectorXd rest = window.residuals;
  if (window.by_start.cols() > 0) {
    // Projection orthogonal to the effect of the start.
    const PivotedQr qr(window.by_start);
    left -= window.by_start * qr.solve(left);
    rest -= window.by_start * qr.solve(rest);
    starts += qr.rank();
  }
  matrix += left.transpose() * left;
  squares += rest.squaredNorm();
  residuals += window.residuals.size();
}

double NormalEquations::variance() const {
  const Eigen::Index free = residuals - starts - matrix.rows();
  return free > 0 ? squares / static_cast<double>(free) : kNaN;
}

bool Information::isIdentifiable(Eigen::Index unknown) const {
  return std::none_of(unidentifiable.begin(), unidentifiable.end(),
                      [&](const UnidentifiableDirection& direction) {
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
  const SymmetricModes<double> modes = symmetricModes(scaled);

  Eigen::MatrixXd known(n, 0);  // identifiable directions, relative to sizes
  const auto addKnown = [&](const Eigen::VectorXd& direction) {
    known.conservativeResize(Eigen::NoChange, known.cols() + 1);
    known.col(known.cols() - 1) = direction;
  };
  const double nothing = kNothing * modes.values.maxCoeff();
  for (Eigen::Index k = 0; k < n; ++k) {
    const Eigen::VectorXd direction = modes.vectors.col(k);
    const double strength = modes.values[k];
    const double deviation = strength > 0.0 ? std::sqrt(rows_alike * variance / strength)
                                            : std::numeric_limits<double>::infinity();
    Eigen::Index largest = 0;
    direction.cwiseAbs().maxCoeff(&largest);
    if (strength <= nothing || deviation > 1.0) {
      result.unidentifiable.push_back({direction / direction[largest], deviation, {}});
    } else {
      addKnown(direction);
    }
  }
  const Eigen::MatrixXd inner = known.transpose() * scaled * known;
  const Eigen::MatrixXd covariance =
      known.cols() == 0 ? Eigen::MatrixXd::Zero(n, n)
                        : Eigen::MatrixXd(variance * known *
                                          Ldlt(inner).solve(Eigen::MatrixXd(known.transpose())));
  for (UnidentifiableDirection& direction : result.unidentifiable) {
    for (Eigen::Index i = 0; i < n; ++i) {
      const double part = std::fabs(direction.parts[i]);
      const bool of_value =
          part >= kMinPart && part * sizes[i] >= kParticipation * std::fabs(theta[i]);
      direction.takes_part.push_back(part >= kParticipation ||
                                     (of_value && part > std::sqrt(covariance(i, i))));
    }
  }
  for (Eigen::Index i = 0; i < n; ++i) {
    if (result.isIdentifiable(i)) {
      result.deviation[i] = sizes[i] * std::sqrt(covariance(i, i));
    }
    for (Eigen::Index j = 0; j < n; ++j) {
      if (result.isIdentifiable(i) && result.isIdentifiable(j)) {
        result.correlation(i, j) =
            covariance(i, j) / std::sqrt(covariance(i, i) * covariance(j, j));
      }
    }
  }
  return result;
}

}  // namespace whirl_twin

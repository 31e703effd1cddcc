#include "analysis/balancing.h"

#include <fmt/format.h>

#include <Eigen/LU>
#include <boost/math/distributions/students_t.hpp>
#include <cmath>
#include <limits>

#include "algebra/dense.h"
#include "messages/input_error.h"

namespace whirl_twin {

Eigen::MatrixXcd influenceOfPlanes(const Eigen::VectorXcd& initial,
                                   const std::vector<TrialRun>& runs, Eigen::Index planes) {
  Eigen::MatrixXcd influence = Eigen::MatrixXcd::Zero(initial.size(), planes);
  Eigen::VectorXd weight = Eigen::VectorXd::Zero(planes);
  for (const TrialRun& run : runs) {
    if (run.plane < 0 || run.plane >= planes) {
      throw InputError(
          fmt::format("balancing: expected a plane below {}, found {}", planes, run.plane));
    }
    if (run.mass_radius == 0.0) {
      throw InputError("balancing: expected a trial mass that is not zero");
    }
    if (run.readings.size() != initial.size()) {
      throw InputError(fmt::format("balancing: expected {} readings of each run, found {}",
                                   initial.size(), run.readings.size()));
    }
    // A column minimizes sum |reading - v_0 - a u|^2 over its runs.
    influence.col(run.plane) += std::conj(run.mass_radius) * (run.readings - initial);
    weight[run.plane] += std::norm(run.mass_radius);
  }
  for (Eigen::Index plane = 0; plane < planes; ++plane) {
    if (weight[plane] == 0.0) {
      throw InputError(
          fmt::format("balancing: expected a trial run for every plane, found none for {}", plane));
    }
    influence.col(plane) /= weight[plane];
  }
  return influence;
}

BalanceCorrection balance(const Eigen::MatrixXcd& influence, const Eigen::VectorXcd& initial,
                          const Eigen::VectorXd& weights) {
  if (influence.rows() != initial.size() || weights.size() != initial.size() ||
      !(weights.array() >= 0.0).all()) {
    throw InputError(
        fmt::format("balancing: expected {} readings and as many weights >= 0, found {} and {}",
                    influence.rows(), initial.size(), weights.size()));
  }
  const Eigen::VectorXcd root = weights.cwiseSqrt().cast<std::complex<double>>();
  const Eigen::MatrixXcd weighted = root.asDiagonal() * influence;
  BalanceCorrection correction;
  correction.mass_radius = leastSquares(weighted, -root.cwiseProduct(initial));
  correction.residual = initial + influence * correction.mass_radius;
  correction.rms = correction.residual.norm() / std::sqrt(static_cast<double>(initial.size()));
  const Eigen::VectorXd singular = singularValues(weighted);
  const bool enough = (weights.array() > 0.0).count() >= influence.cols();
  correction.condition = enough && singular.minCoeff() > 0.0
                             ? singular.maxCoeff() / singular.minCoeff()
                             : std::numeric_limits<double>::infinity();
  return correction;
}

std::optional<CorrectionSpread> correctionSpread(const Eigen::MatrixXcd& influence,
                                                 const std::vector<TrialRun>& runs,
                                                 const Eigen::VectorXd& weights,
                                                 const BalanceCorrection& correction,
                                                 double deviation) {
  constexpr double kSame = 1.0e12;  // condition number from which planes do the same
  const Eigen::Index planes = influence.cols();
  const Eigen::Index spare = (weights.array() > 0.0).count() - planes;
  if (!(correction.condition < kSame) || (deviation == 0.0 && spare < 1)) {
    return std::nullopt;
  }
  const Eigen::MatrixXcd weighted = weights.cast<std::complex<double>>().asDiagonal() * influence;
  const Eigen::MatrixXcd inverse = (influence.adjoint() * weighted).inverse();
  CorrectionSpread spread;
  if (deviation == 0.0) {
    // The residual has the errors of the first run and of A u together, as the correction has.
    const double squares = weights.dot(correction.residual.cwiseAbs2());
    const auto free = static_cast<double>(2 * spare);
    spread.deviation = (squares / free * inverse.diagonal().real()).cwiseSqrt();
    spread.within95 = boost::math::quantile(boost::math::students_t(free), 0.975);
    return spread;
  }
  // du = -inverse A* W (dv_0 + dA u), in which run k has the part u_j conj(t_k) / sum |t|^2.
  Eigen::VectorXd masses = Eigen::VectorXd::Zero(planes);
  for (const TrialRun& run : runs) {
    masses[run.plane] += std::norm(run.mass_radius);
  }
  std::complex<double> first = 1.0;
  double others = 0.0;
  for (const TrialRun& run : runs) {
    const std::complex<double> part =
        correction.mass_radius[run.plane] * std::conj(run.mass_radius) / masses[run.plane];
    first -= part;
    others += std::norm(part);
  }
  const Eigen::MatrixXcd covariance = inverse * (weighted.adjoint() * weighted) * inverse.adjoint();
  spread.deviation =
      deviation * ((std::norm(first) + others) * covariance.diagonal().real()).cwiseSqrt();
  spread.within95 = 1.959963984540054;
  return spread;
}

}  // namespace whirl_twin

#include "analysis/balancing.h"

#include <fmt/format.h>

#include <cmath>
#include <limits>

#include "algebra/dense.h"
#include "messages/refusal.h"

namespace whirl_twin {

Eigen::MatrixXcd influenceOfPlanes(const Eigen::VectorXcd& initial,
                                   const std::vector<TrialRun>& runs, Eigen::Index planes) {
  Eigen::MatrixXcd influence = Eigen::MatrixXcd::Zero(initial.size(), planes);
  Eigen::VectorXd weight = Eigen::VectorXd::Zero(planes);
  for (const TrialRun& run : runs) {
    if (run.plane < 0 || run.plane >= planes) {
      throw Refusal(
          fmt::format("balancing: expected a plane below {}, found {}", planes, run.plane));
    }
    if (run.mass_radius == 0.0) {
      throw Refusal("balancing: expected a trial mass that is not zero");
    }
    if (run.readings.size() != initial.size()) {
      throw Refusal(fmt::format("balancing: expected {} readings of each run, found {}",
                                initial.size(), run.readings.size()));
    }
    // A column minimizes sum |reading - v_0 - a u|^2 over its runs.
    influence.col(run.plane) += std::conj(run.mass_radius) * (run.readings - initial);
    weight[run.plane] += std::norm(run.mass_radius);
  }
  for (Eigen::Index plane = 0; plane < planes; ++plane) {
    if (weight[plane] == 0.0) {
      throw Refusal(
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
    throw Refusal(
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
  correction.condition = singular.minCoeff() > 0.0 ? singular.maxCoeff() / singular.minCoeff()
                                                   : std::numeric_limits<double>::infinity();
  return correction;
}

}  // namespace whirl_twin

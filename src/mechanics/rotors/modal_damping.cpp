#include "mechanics/rotors/modal_damping.h"

#include <algorithm>
#include <cmath>

#include "algebra/dense.h"

namespace whirl_twin {

double ratioAt(const std::vector<DampingRatio>& ratios, double frequency) {
  const auto above = std::find_if(ratios.begin(), ratios.end(), [frequency](const DampingRatio& r) {
    return r.frequency > frequency;
  });
  if (above == ratios.begin() || above == ratios.end()) {
    return above == ratios.begin() ? ratios.front().ratio : ratios.back().ratio;
  }
  const DampingRatio& below = *(above - 1);
  const double share = (frequency - below.frequency) / (above->frequency - below.frequency);
  return below.ratio + share * (above->ratio - below.ratio);
}

Eigen::MatrixXd modalDamping(const Eigen::MatrixXd& mass, const Eigen::MatrixXd& stiffness,
                             const std::vector<DampingRatio>& ratios) {
  // Turns and displacements of one size first: the frequencies of a long shaft span six decades.
  const Eigen::VectorXd unit = mass.diagonal().cwiseSqrt().cwiseInverse();
  const Cholesky factor(unit.asDiagonal() * mass * unit.asDiagonal());
  if (!mass.allFinite() || !stiffness.allFinite() || !factor.succeeded()) {
    return Eigen::MatrixXd::Zero(mass.rows(), mass.cols());
  }
  const Eigen::MatrixXd half = factor.solveLower(unit.asDiagonal() * stiffness * unit.asDiagonal());
  const Eigen::MatrixXd whole = factor.solveLower(half.transpose());
  const SymmetricModes<double> modes = symmetricModes(0.5 * (whole + whole.transpose()));
  Eigen::VectorXd by_rate(mass.rows());
  for (Eigen::Index i = 0; i < by_rate.size(); ++i) {
    const double frequency = std::sqrt(std::max(0.0, modes.values[i]));
    by_rate[i] = 2.0 * ratioAt(ratios, frequency) * frequency;
  }
  const Eigen::MatrixXd shapes = unit.cwiseInverse().asDiagonal() * factor.lower() * modes.vectors;
  return shapes * by_rate.asDiagonal() * shapes.transpose();
}

}  // namespace whirl_twin

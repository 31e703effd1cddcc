#include "analysis/balanced_matrix.h"

#include <cmath>

namespace whirl_twin {

namespace {

constexpr int kMaxRounds = 100;
constexpr double kWorthIt = 0.95;

}  // namespace

Eigen::MatrixXd balanced(const Eigen::MatrixXd& a) {
  const Eigen::VectorXd units = balancingUnits(a);
  return units.cwiseInverse().asDiagonal() * a * units.asDiagonal();
}

Eigen::VectorXd balancingUnits(Eigen::MatrixXd a) {
  Eigen::VectorXd units = Eigen::VectorXd::Ones(a.rows());
  bool changed = true;
  for (int round = 0; changed && round < kMaxRounds; ++round) {
    changed = false;
    for (Eigen::Index i = 0; i < a.rows(); ++i) {
      const double own = std::fabs(a(i, i));
      const double column = a.col(i).cwiseAbs().sum() - own;
      const double row = a.row(i).cwiseAbs().sum() - own;
      if (!(column > 0.0 && row > 0.0) || !std::isfinite(column + row)) {
        continue;
      }
      const double factor = std::exp2(std::round(0.5 * std::log2(row / column)));
      if (column * factor + row / factor < kWorthIt * (column + row)) {
        a.col(i) *= factor;
        a.row(i) /= factor;
        units[i] *= factor;
        changed = true;
      }
    }
  }
  return units;
}

}  // namespace whirl_twin

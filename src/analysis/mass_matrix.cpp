#include "analysis/mass_matrix.h"

#include <Eigen/Eigenvalues>

namespace whirl_twin {

Eigen::VectorXd naturalUnits(const Dynamics& dynamics) {
  Eigen::VectorXd unit(dynamics.dof());
  const std::vector<CoordinateInfo> coordinates = dynamics.coordinates();
  for (Eigen::Index i = 0; i < unit.size(); ++i) {
    unit[i] = coordinates[static_cast<std::size_t>(i)].isAngle() ? 1.0 : dynamics.naturalLength();
  }
  return unit;
}

double massRegularity(const Dynamics& dynamics, const Eigen::VectorXd& q, const Eigen::VectorXd& v,
                      const Moment<double>& at) {
  const Eigen::VectorXd unit = naturalUnits(dynamics);
  const Eigen::MatrixXd mass =
      unit.asDiagonal() * dynamics.massMatrix(q, v, at) * unit.asDiagonal();
  const Eigen::VectorXd values =
      Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd>(mass, Eigen::EigenvaluesOnly).eigenvalues();
  const double largest = values.cwiseAbs().maxCoeff();
  return largest > 0.0 ? values[0] / largest : 0.0;
}

}  // namespace whirl_twin

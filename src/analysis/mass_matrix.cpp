#include "analysis/mass_matrix.h"

#include "algebra/dense.h"

namespace whirl_twin {

Eigen::VectorXd naturalUnits(const Dynamics& dynamics) {
  Eigen::VectorXd unit(dynamics.dof());
  const std::vector<CoordinateInfo> coordinates = dynamics.coordinates();
  for (Eigen::Index i = 0; i < unit.size(); ++i) {
    unit[i] = coordinates[static_cast<std::size_t>(i)].isAngle() ? 1.0 : dynamics.naturalLength();
  }
  return unit;
}

bool massIsSingular(const Dynamics& dynamics, const Eigen::VectorXd& q, const Eigen::VectorXd& v,
                    const Moment<double>& at) {
  const Eigen::MatrixXd mass = dynamics.massMatrix(q, v, at);
  const Eigen::VectorXd diagonal = mass.diagonal();
  if (!(diagonal.minCoeff() > 0.0)) {
    return true;
  }
  const Eigen::VectorXd scale = diagonal.cwiseSqrt().cwiseInverse();
  constexpr double kRounding = 1.0e-15;
  return !(symmetricEigenvalues(scale.asDiagonal() * mass * scale.asDiagonal())[0] > kRounding);
}

double massRegularity(const Dynamics& dynamics, const Eigen::VectorXd& q, const Eigen::VectorXd& v,
                      const Moment<double>& at) {
  const Eigen::VectorXd all_units = naturalUnits(dynamics);
  const Eigen::VectorXd unit = all_units / all_units.maxCoeff();  // their ratio is what matters
  const Eigen::VectorXd values =
      symmetricEigenvalues(unit.asDiagonal() * dynamics.massMatrix(q, v, at) * unit.asDiagonal());
  const double largest = values.cwiseAbs().maxCoeff();
  return largest > 0.0 ? values[0] / largest : 0.0;
}

}  // namespace whirl_twin

#include "analysis/constraint_audit.h"

#include <Eigen/QR>
#include <stdexcept>

namespace whirl_twin {

ConstraintAudit auditConstraints(const Eigen::MatrixXd& jacobian) {
  if (jacobian.cols() == 0 || !jacobian.allFinite()) {
    throw std::invalid_argument(
        "constraints: expected a Jacobian of finite numbers with a column for each coordinate");
  }
  ConstraintAudit audit;
  audit.coordinates = static_cast<int>(jacobian.cols());
  audit.constraints = static_cast<int>(jacobian.rows());
  audit.degrees_of_freedom = audit.coordinates;
  audit.admissible = Eigen::MatrixXd::Identity(jacobian.cols(), jacobian.cols());
  if (jacobian.rows() == 0) {
    return audit;
  }
  // The gradients as columns: the first `independent` columns of Q span them, the rest is
  // admissible.
  Eigen::ColPivHouseholderQR<Eigen::MatrixXd> gradients;
  gradients.setThreshold(1e-10);
  gradients.compute(jacobian.rowwise().normalized().transpose());
  audit.independent = static_cast<int>(gradients.rank());
  audit.degrees_of_freedom -= audit.independent;
  const Eigen::MatrixXd q = gradients.householderQ() * audit.admissible;
  audit.admissible = q.rightCols(audit.degrees_of_freedom);
  return audit;
}

}  // namespace whirl_twin

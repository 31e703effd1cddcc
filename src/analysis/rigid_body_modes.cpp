#include "analysis/rigid_body_modes.h"

#include "algebra/dense.h"
#include "messages/refusal.h"

namespace whirl_twin {

Eigen::MatrixXd rigidBodyModes(const Eigen::MatrixXd& stiffness) {
  if (definiteness(stiffness, "stiffness") == Definiteness::kIndefinite) {
    throw RunFailure(
        "stiffness: it is negative for some motion, so the position is statically unstable: a "
        "small "
        "displacement grows instead of vibrating");
  }
  const ScaledForm scaled = unitDiagonal(stiffness);
  const SymmetricModes<double> solver = symmetricModes(scaled.form);
  const Eigen::Index free = (solver.values.array() <= kZeroEigenvalue).count();
  if (free == 0) {
    return Eigen::MatrixXd(stiffness.rows(), 0);
  }
  const Eigen::MatrixXd motions = scaled.scale.asDiagonal() * solver.vectors.leftCols(free);
  return orthonormalBasis(motions.leftCols(free));
}

}  // namespace whirl_twin

#include "analysis/influence_coefficients.h"

#include <fmt/format.h>

#include "algebra/dense.h"
#include "analysis/rigid_body_modes.h"
#include "messages/refusal.h"

namespace whirl_twin {

Eigen::MatrixXd influenceCoefficients(const Eigen::MatrixXd& stiffness) {
  const Eigen::Index free = rigidBodyModes(stiffness).cols();
  if (free > 0) {
    throw RunFailure(
        fmt::format("influence coefficients: the stiffness is singular, with {} rigid-body mode{}: "
                    "without supports a unit force accelerates the system instead of deflecting it",
                    free, free > 1 ? "s" : ""));
  }
  const ScaledForm scaled = unitDiagonal(stiffness);
  const Eigen::MatrixXd inverse =
      Cholesky(scaled.form).solve(Eigen::MatrixXd::Identity(stiffness.rows(), stiffness.cols()));
  const Eigen::MatrixXd a = scaled.scale.asDiagonal() * inverse * scaled.scale.asDiagonal();
  return 0.5 * (a + a.transpose());
}

}  // namespace whirl_twin

#include "analysis/rayleigh_quotient.h"

#include <fmt/format.h>

#include <cmath>
#include <stdexcept>

#include "analysis/influence_coefficients.h"
#include "analysis/natural_modes.h"
#include "analysis/quadratic_form.h"
#include "messages/refusal.h"

namespace whirl_twin {

namespace {

void requireSize(const Eigen::VectorXd& vector, const Eigen::MatrixXd& matrix, const char* what) {
  if (vector.size() != matrix.rows()) {
    throw std::logic_error(
        fmt::format("{}: expected {} entries, found {}", what, matrix.rows(), vector.size()));
  }
}

}  // namespace

double rayleighFrequency(const Eigen::MatrixXd& mass, const Eigen::MatrixXd& stiffness,
                         const Eigen::VectorXd& shape) {
  requireSameSize(mass, stiffness);
  requirePositiveDefinite(mass, "mass");
  requireSymmetric(stiffness, "stiffness");
  requireSize(shape, mass, "assumed shape");
  if (!shape.allFinite() || shape.isZero(0.0)) {
    throw Refusal("assumed shape: expected finite entries, not all of them zero");
  }
  const Eigen::VectorXd phi = shape / shape.cwiseAbs().maxCoeff();
  const double squared = phi.dot(stiffness * phi) / phi.dot(mass * phi);
  // A rigid-body shape leaves the rounding of the sum, which can be negative.
  const double rounding =
      1e-12 * phi.cwiseAbs().dot(stiffness.cwiseAbs() * phi.cwiseAbs()) / phi.dot(mass * phi);
  if (squared < -rounding) {
    throw RunFailure(
        fmt::format("Rayleigh's quotient: the stiffness is negative for the assumed shape, p^2 = "
                    "{:.6g} (rad/s)^2: the position is statically unstable",
                    squared));
  }
  return std::sqrt(squared > 0.0 ? squared : 0.0);
}

Eigen::VectorXd staticDeflection(const Eigen::MatrixXd& stiffness, const Eigen::VectorXd& load) {
  requireSize(load, stiffness, "load");
  return influenceCoefficients(stiffness) * load;
}

Eigen::VectorXd weight(const Eigen::MatrixXd& mass, const Eigen::VectorXd& down, double gravity) {
  requireSize(down, mass, "direction of the weight");
  return gravity * (mass * down);
}

}  // namespace whirl_twin

#include "analysis/dunkerley.h"

#include <cmath>

#include "analysis/influence_coefficients.h"
#include "analysis/natural_modes.h"
#include "analysis/quadratic_form.h"

namespace whirl_twin {

DunkerleyBound dunkerleyBound(const Eigen::MatrixXd& mass, const Eigen::MatrixXd& stiffness) {
  requireSameSize(mass, stiffness);
  requirePositiveDefinite(mass, "mass");
  const Eigen::VectorXd terms = (influenceCoefficients(stiffness) * mass).diagonal();
  return {1.0 / std::sqrt(terms.sum()), terms};
}

}  // namespace whirl_twin

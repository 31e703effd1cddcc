#include "analysis/validity.h"

#include <fmt/format.h>

#include "analysis/mass_matrix.h"

namespace whirl_twin {

bool hasConditions(const Dynamics& dynamics) {
  const Eigen::VectorXd zero = Eigen::VectorXd::Zero(dynamics.dof());
  return !dynamics.singularMass().empty() || !dynamics.conditions(zero, zero, zero, {}).empty();
}

std::vector<Condition> validity(const Dynamics& dynamics, const Eigen::VectorXd& q,
                                const Eigen::VectorXd& v, const Moment<double>& at) {
  std::vector<Condition> all = dynamics.conditions(q, v, dynamics.acceleration(q, v, at), at);
  const std::string reason = dynamics.singularMass();
  if (!reason.empty()) {
    all.push_back({"regular_mass", "-", massRegularity(dynamics, q, v, at) - kNearlySingularMass,
                   "the mass matrix is nearly singular: " + reason});
  }
  return all;
}

std::string brokenText(const std::vector<Condition>& conditions, Margins margins) {
  std::string text;
  for (const Condition& c : conditions) {
    if (!(c.margin > 0.0)) {
      const std::string margin =
          margins == Margins::kShown
              ? fmt::format(" {:.3g}{}", c.margin, c.unit == "-" ? "" : " " + c.unit)
              : "";
      text += fmt::format("{}{} ({}{})", text.empty() ? "" : "; ", c.broken, c.name, margin);
    }
  }
  return text;
}

}  // namespace whirl_twin

#include "analysis/virtual_work.h"

#include <fmt/format.h>

#include <stdexcept>

namespace whirl_twin {

double virtualWork(const Dynamics& dynamics, const Eigen::VectorXd& q,
                   const Eigen::VectorXd& displacement, const Moment<double>& at) {
  if (q.size() != dynamics.dof() || displacement.size() != dynamics.dof()) {
    throw std::logic_error(fmt::format(
        "virtual work: expected {} coordinates and as many displacements, found {} and {}",
        dynamics.dof(), q.size(), displacement.size()));
  }
  return dynamics.unbalancedForce(q, Eigen::VectorXd::Zero(dynamics.dof()), at).dot(displacement);
}

}  // namespace whirl_twin

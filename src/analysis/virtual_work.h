// The principle of virtual work (lecture notes): a system of bodies at rest is in equilibrium if
// the work of all its forces is zero for every virtual displacement that the constraints admit,
//   delta W = sum of Q_i delta q_i = 0.
// The forces of rigid constraints do none, so that they never appear.
#pragma once

#include <Eigen/Core>

#include "mechanics/dynamics.h"

namespace whirl_twin {

/// delta W [J] of all forces on a system held at rest in q, for a virtual displacement of its
/// coordinates [dof] at one moment: work of the first order, the force taken as it is in q. Zero
/// for every displacement at an equilibrium. Throws std::logic_error for a wrong size.
double virtualWork(const Dynamics& dynamics, const Eigen::VectorXd& q,
                   const Eigen::VectorXd& displacement, const Moment<double>& at);

}  // namespace whirl_twin

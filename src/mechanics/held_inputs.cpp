#include "mechanics/held_inputs.h"

#include "algebra/constants.h"
#include "mechanics/locally_forced_rotor.h"

namespace whirl_twin {

namespace {

using Eigen::Index;
using Eigen::MatrixXd;

void add(const LocalForce& force, const Eigen::VectorXd& q, const Eigen::VectorXd& inputs,
         HeldInputs& held) {
  LocalState at;
  at.place = {force.along_x.dot(q), force.along_y.dot(q)};
  NodalForce without;
  const bool room = force.law->push(at, without);
  const LocalSlopes slopes_without = force.law->slopes(at);
  for (std::size_t i = 0; i < 2; ++i) {
    at.input[i] = inputs[static_cast<Index>(force.inputs[i])];
  }
  NodalForce with;
  if (!room || !force.law->push(at, with)) {
    held.force.fill(kNaN);
    return;
  }
  const LocalSlopes slopes = force.law->slopes(at);
  MatrixXd along(q.size(), 2);
  along << force.along_x, force.along_y;
  held.force += (with.force[0] - without.force[0]) * force.along_x +
                (with.force[1] - without.force[1]) * force.along_y;
  held.stiffness += along * (slopes.stiffness - slopes_without.stiffness) * along.transpose();
  const MatrixXd by_input = along * slopes.by_input;
  for (std::size_t i = 0; i < 2; ++i) {
    held.by_input.col(static_cast<Index>(force.inputs[i])) += by_input.col(static_cast<Index>(i));
  }
}

}  // namespace

HeldInputs heldInputs(const Dynamics& dynamics, const Eigen::VectorXd& q,
                      const Eigen::VectorXd& inputs) {
  HeldInputs held{Eigen::VectorXd::Zero(q.size()), MatrixXd::Zero(q.size(), inputs.size()),
                  MatrixXd::Zero(q.size(), q.size())};
  const std::vector<InputInfo> infos = dynamics.inputs();
  for (std::size_t i = 0; i < infos.size(); ++i) {
    const auto column = static_cast<Index>(i);
    held.by_input.col(column) = infos[i].direction;
    held.force += inputs[column] * infos[i].direction;
  }
  if (const auto* const rotor = dynamic_cast<const LocallyForcedRotor*>(&dynamics)) {
    for (const LocalForce& force : rotor->forces()) {
      if (force.inputs[0] != LocalForce::kNoInput) {
        add(force, q, inputs, held);
      }
    }
  }
  return held;
}

}  // namespace whirl_twin

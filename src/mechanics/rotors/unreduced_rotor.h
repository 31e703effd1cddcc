// The rotor that a reduced one was made of: who judges the reduced one can ask what the reduction
// has changed.
#pragma once

#include <Eigen/Core>
#include <memory>
#include <vector>

#include "mechanics/local_force.h"
#include "mechanics/rotors/rotor_assembly.h"

namespace whirl_twin {

struct UnreducedRotor {
  std::shared_ptr<const RotorAssembly> assembly;  ///< in all coordinates
  Eigen::MatrixXd shapes;                         ///< q = shapes * amplitudes [dof x n]
  std::vector<LocalForce> forces;                 ///< that are not linear, in all coordinates
};

}  // namespace whirl_twin

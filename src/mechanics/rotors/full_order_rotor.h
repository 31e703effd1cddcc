// The full-order rotor of a reduced-order one, to evaluate the effect of the reduction.
#pragma once

#include <Eigen/Core>
#include <memory>
#include <vector>

#include "mechanics/local_force.h"
#include "mechanics/rotors/rotor_assembly.h"

namespace whirl_twin {

struct FullOrderRotor {
  std::shared_ptr<const RotorAssembly> assembly;  ///< in all coordinates
  Eigen::MatrixXd shapes;                         ///< q = shapes * amplitudes [dof x n]
  std::vector<LocalForce> forces;                 ///< that are not linear, in all coordinates
};

}  // namespace whirl_twin

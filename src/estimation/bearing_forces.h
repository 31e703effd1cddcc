// Bearing forces of a rotor as linear functions of its coordinates and rates: bearings of flexible
// rotors with eight coefficients. Excluded: bearings with coefficient tables over the speed, on
// pedestals or with an added mass, and journal bearings.
#pragma once

#include <Eigen/Core>
#include <string>
#include <vector>

#include "scene/built_system.h"

namespace whirl_twin {

/// Force on the shaft [N]: x.dot(state), y.dot(state), with state = coordinates and rates [2 dof].
struct BearingForce {
  std::string name;  ///< as in the scene, `bearings[0]`
  Eigen::VectorXd x, y;
};

std::vector<BearingForce> bearingForces(const BuiltSystem& system);

}  // namespace whirl_twin

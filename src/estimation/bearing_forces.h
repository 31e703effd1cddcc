// What the bearings of a rotor bear, as rows over its coordinates and rates: of a flexible rotor's
// bearings by eight coefficients. Those whose coefficients go by tables over the speed, that stand
// on pedestals or move a mass along, and journal bearings, are left out.
#pragma once

#include <Eigen/Core>
#include <string>
#include <vector>

#include "scene/built_system.h"

namespace whirl_twin {

/// Force on the shaft [N]: x.dot(state), y.dot(state), of coordinates and rates [2 dof].
struct BearingForce {
  std::string name;  ///< as in the scene, `bearings[0]`
  Eigen::VectorXd x, y;
};

std::vector<BearingForce> bearingForces(const BuiltSystem& system);

}  // namespace whirl_twin

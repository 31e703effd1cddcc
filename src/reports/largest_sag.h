// How far its weight bends a rotor, apart from its vibration about there.
#pragma once

#include <Eigen/Core>
#include <optional>
#include <string>

#include "mechanics/dynamics.h"
#include "reports/output.h"

namespace whirl_twin {

struct LargestSag {
  std::string station;
  double x = 0.0, y = 0.0;  ///< [m]
};

/// Where along the shaft of a rotor its equilibrium q is farthest from the line of its bearings.
/// Nothing of another system, and of a rotor that nothing bends.
std::optional<LargestSag> largestSag(const Dynamics& dynamics, const Eigen::VectorXd& q);

/// "0.00098 m at disc (x 0 m, y -0.00098 m)"
std::string text(const LargestSag& sag);
Json json(const std::optional<LargestSag>& sag);

}  // namespace whirl_twin

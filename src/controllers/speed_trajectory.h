// Speed trajectory and torque limit of a controller of type `speed`, for checks of feasibility in
// advance.
#pragma once

#include <algorithm>
#include <vector>

#include "control/exclusion_bands.h"
#include "control/speed_planner.h"
#include "controllers/controller_info.h"

namespace whirl_twin {

struct SpeedTrajectory {
  ShaftLimits limits;
  double torque_limit = 0.0;     ///< [N m], of its actuator
  double target = 0.0;           ///< [rad/s]
  double run_up = 0.0;           ///< [rad/s], before a band
  std::vector<SpeedBand> bands;  ///< ascending, above 0, separated by more than the run-up

  /// The maximum torque [N m] at a speed [rad/s].
  double torque(double speed) const noexcept {
    return std::min(torque_limit, limits.torque(speed));
  }
};

/// Throws SetupError as the controller does when it is made.
SpeedTrajectory speedWayOf(const ParameterValues& values, const Settings& settings,
                           const ControllerPlan& plan);

}  // namespace whirl_twin

// MuJoCo on the double pendulum: its Runge-Kutta method of order 4, with a ladder of timesteps.
//
// It has no point masses: every body needs a rotational inertia, here 1e-12 kg m^2 compared with
// m l^2 = 1 kg m^2. That limits its accuracy to about 1e-12 times the sensitivity of the motion.
// Its joint angles are relative; the lower one is added to the upper before they are compared.
#pragma once

#include <vector>

#include "contender.h"

namespace whirl_twin::comparison {

/// The double pendulum of DoublePendulumEquations, from angles [rad] measured from the vertical.
void addMujoco(double upper_angle, double lower_angle, const Output& output,
               std::vector<Contender>& contenders);

}  // namespace whirl_twin::comparison

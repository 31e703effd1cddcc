// Coupling of lateral motion and spin of a linear rotor driven by a motor:
//
//   J w' = T(w) - d w - s(theta) . q'' + q^T N_1 q' - w q^T S q
//
// s = Re[i F e^(i theta)], F the unbalances [kg m] and the couples of skewed discs [kg m^2], whose
// force on the whirl is -d(w s)/dt. w N_1 is the circulatory matrix of the rotating damping, S the
// damping in the rotating frame: for a round shaft's material, whose force is C_i (q' - w x q), N_1
// = -C_i x and S = C_i. Gyroscopic moments do no work and do not act on the spin: w is the rate
// about the discs' own axes (linear_rotor.h). All terms follow from the energies
//
//   T = q'^T M q' / 2 + w s . q' + J w^2 / 2,   D = q'^T C q' / 2 + w q'^T N_1 q + w^2 q^T S q / 2
#pragma once

#include <Eigen/Core>

#include "control/motor.h"

namespace whirl_twin {

struct SpinCoupling {
  double polar_inertia = 0.0;   ///< J [kg m^2], about the shaft, of all that turns
  Motor motor;                  ///< with its drag
  Eigen::MatrixXd circulatory;  ///< N_1 [dof x dof], skew
  Eigen::MatrixXd resistance;   ///< S [dof x dof], symmetric
};

}  // namespace whirl_twin

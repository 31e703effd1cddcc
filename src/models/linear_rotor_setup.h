// The setup of a model whose dynamics are a linear rotor, or that steps as one in a run-up.
#pragma once

#include <memory>
#include <vector>

#include "integration/jacobi_integral.h"
#include "mechanics/dynamics.h"
#include "mechanics/linear_dynamics.h"
#include "mechanics/local_force.h"
#include "mechanics/spin_coupling.h"
#include "models/model_info.h"

namespace whirl_twin {

// The setup of a model that is a linear system given by its matrices.

/// A setup that steps with every method of linear systems. Throws InputError as
/// LinearDynamics does.
ModelSetup linearSetup(LinearModel model);

/// The setup of a model whose dynamics are a linear rotor: it steps with `exponential`, at constant
/// and at changing speed. With local forces it is the rotor of what is linear in them, and the
/// setup's dynamics have them all.
ModelSetup linearRotorSetup(std::shared_ptr<const Dynamics> dynamics,
                            std::vector<LocalForce> forces = {});

/// The same of a rotor whose shaft a motor turns, prepared for speeds up to the one at which the
/// motor's torque comes down to its drag; up to `highest_speed` [rad/s] where there is no such, and
/// where something else acts on the shaft. Throws InputError as SpinningRotor does.
ModelSetup spinningRotorSetup(std::shared_ptr<const Dynamics> held, std::vector<LocalForce> forces,
                              SpinCoupling coupling, double highest_speed);

/// A setup of a linear model with a shaft, in the fixed frame, whose `exponential` follows a
/// changing speed: of two coordinates without inputs by LateralRotorStepper, else by that step.
ModelSetup withExactRunUps(ModelSetup setup, JacobiIntegral jacobi);

/// A setup of a nonlinear model with a shaft that is a linear rotor, in the fixed frame, and a few
/// nodal forces: its `exponential` integrates the linear part exactly, as that of
/// linearRotorSetup(). The linear part of the forces, `damping` at their nodes [N s/m], is added to
/// it; `jacobi` is that of LinearRotorStepper.
ModelSetup withExactLinearPart(ModelSetup setup, std::shared_ptr<const Dynamics> linear,
                               double damping, JacobiIntegral jacobi,
                               std::vector<LocalForce> forces);

}  // namespace whirl_twin

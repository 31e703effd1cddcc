// The states that users see, filled from what a record holds and the tracks that follow it. Names
// and instants are the observer's to add.
#pragma once

#include <vector>

#include "control/motor.h"
#include "mechanics/dynamics.h"
#include "messages/controller_state.h"
#include "messages/states.h"
#include "scene/scene.h"
#include "twin/motor_track.h"
#include "twin/record.h"
#include "twin/whirl_phase.h"

namespace whirl_twin {

/// Below `slowest_orbit` [rad/s] there is no 1X orbit to speak of.
state::WhirlState whirlState(const WhirlMotion& at, const WhirlPhase& phase, const ShaftView& shaft,
                             double slowest_orbit);
state::PendulumState pendulumState(const std::vector<CoordinateInfo>& coordinates,
                                   const SystemView& system, const Energies& energies);
state::DriveState driveState(const ShaftView& shaft);
/// Energies of the system that the motor turns.
state::MotorState motorState(const Motor& motor, const MotorTrack& track, const ShaftView& shaft,
                             const Energies& energies);

state::ControllerState controllerState(const ControllerSpec& spec, const Scene& scene,
                                       const ControllerPlace<const double>& controller);

}  // namespace whirl_twin

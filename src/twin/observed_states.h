// Fills state messages from a record and from the tracks of the observer. Names and instants are
// added by the observer.
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

/// Below `slowest_orbit` [rad/s] the 1X orbit is not defined.
state::WhirlState whirlState(const WhirlMotion& at, const WhirlPhase& phase, const ShaftView& shaft,
                             double slowest_orbit);
state::PendulumState pendulumState(const std::vector<CoordinateInfo>& coordinates,
                                   const SystemView& system, const Energies& energies);
state::DriveState driveState(const ShaftView& shaft);
/// Energies of the system driven by the motor.
state::MotorState motorState(const Motor& motor, const MotorTrack& track, const ShaftView& shaft,
                             const Energies& energies);

state::ControllerState controllerState(const ControllerSpec& spec, const Scene& scene,
                                       const ControllerPlace<const double>& controller);

}  // namespace whirl_twin

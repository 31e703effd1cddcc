// A rotor on its motor, taken apart: the rotor as it is while its shaft turns at a constant speed,
// and the motor. Critical speeds are those of the first, Sommerfeld's effect is the balance of
// both.
#pragma once

#include <memory>
#include <optional>

#include "control/motor.h"
#include "mechanics/dynamics.h"
#include "mechanics/rotors/rotor_assembly.h"
#include "scene/built_system.h"

namespace whirl_twin {

struct RotorOnMotor {
  std::shared_ptr<const Dynamics> held;
  Motor motor;  ///< with its drag
};

/// Of a system that a motor of the scene turns, and of a free_rotor, whose torque is its own;
/// nothing for any other.
std::optional<RotorOnMotor> rotorOnMotor(const BuiltSystem& system);

/// The dynamics that have the system's critical speeds: with the shaft held, of a rotor on a motor.
std::shared_ptr<const Dynamics> heldDynamics(const BuiltSystem& system);

/// That its tables of bearings and pedestals cover; of another system every speed.
DataSpeeds tableSpeeds(const BuiltSystem& system);

}  // namespace whirl_twin

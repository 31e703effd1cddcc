// Splits a rotor driven by a motor into the rotor at a constant speed of its shaft, and the motor.
// The rotor determines the critical speeds, the torque balance of both Sommerfeld's effect.
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
  Motor motor;  ///< including its drag
};

/// Of a system driven by a motor of the scene, and of a free_rotor, which has a torque; nothing for
/// any other.
std::optional<RotorOnMotor> rotorOnMotor(const BuiltSystem& system);

/// The dynamics that determine the critical speeds: for a rotor on a motor, those at constant
/// speed.
std::shared_ptr<const Dynamics> heldDynamics(const BuiltSystem& system);

/// The speeds that the system's tables of bearings and pedestals cover; without tables every speed.
DataSpeeds tableSpeeds(const BuiltSystem& system);

}  // namespace whirl_twin

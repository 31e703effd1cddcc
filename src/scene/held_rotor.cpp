#include "scene/held_rotor.h"

#include "mechanics/locally_forced_rotor.h"
#include "models/model_registry.h"
#include "scene/system_setup.h"

namespace whirl_twin {
namespace {

/// A free_rotor is a Jeffcott rotor driven by a torque, in coordinates of its disc.
std::optional<RotorOnMotor> freeRotor(const BuiltSystem& system) {
  const ModelInfo& jeffcott = *findModel("jeffcott_rotor");
  const ParameterValues& own = system.spec.parameters;
  ParameterValues values;
  for (const ParameterInfo& parameter : jeffcott.parameters) {
    const auto same = own.find(parameter.name);
    values[parameter.name] = same != own.end() ? same->second : parameter.fallback.value_or(0.0);
  }
  values["stiffness_y"] = values.at("stiffness");
  values["damping_y"] = values.at("damping");
  return RotorOnMotor{jeffcott.setUp(values, {}, system.spec.setup->around).dynamics,
                      Motor::constant(own.at("torque"), own.at("drag"))};
}

}  // namespace

std::optional<RotorOnMotor> rotorOnMotor(const BuiltSystem& system) {
  if (system.model->name == "free_rotor") {
    return freeRotor(system);
  }
  const SystemSetup& setup = *system.spec.setup;
  if (!setup.around.motor) {
    return std::nullopt;
  }
  ModelContext around = setup.around;
  around.motor.reset();
  return RotorOnMotor{setup.model->setUp(setup.parameters, setup.settings, around).dynamics,
                      *setup.around.motor};
}

std::shared_ptr<const Dynamics> heldDynamics(const BuiltSystem& system) {
  const std::optional<RotorOnMotor> driven = rotorOnMotor(system);
  return driven ? driven->held : system.dynamics;
}

DataSpeeds tableSpeeds(const BuiltSystem& system) {
  const std::shared_ptr<const Dynamics> held = heldDynamics(system);
  const bool linear = held->linear() && held->isRotor() && held->hasShaft();
  return linear || dynamic_cast<const LocallyForcedRotor*>(held.get()) != nullptr
             ? dataSpeeds(held->linearRotor())
             : DataSpeeds{};
}

}  // namespace whirl_twin

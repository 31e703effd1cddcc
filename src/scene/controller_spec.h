// Specification of the controllers of a scene: measured signals, timing, control law, inputs acted
// on.
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

#include "control/actuator.h"
#include "control/exclusion_bands.h"
#include "control/sensor.h"
#include "controllers/controller_info.h"
#include "scene/sensor_spec.h"

namespace whirl_twin {

/// An input of a system, by its index in the dynamics.
struct ActedInput {
  std::size_t system = 0;  ///< of Scene::systems
  std::size_t input = 0;
};

/// A band of speeds that a motor cannot cross with a steady whirl.
struct ResonancePassageCheck {
  SpeedBand band;
  double speed = 0.0;   ///< [rad/s], of the largest lack of torque
  double needed = 0.0;  ///< [N m], there; infinite for undamped whirl
  double given = 0.0;   ///< [N m], there, largest available
  bool tried = false;   ///< crossed nevertheless: the simulation passes, or the scene requests it
};

struct ControllerSpec {
  std::string name;
  std::string type;         ///< one of controllerNames()
  double rate = 0.0;        ///< [Hz]; sample k at k / rate after simulated time 0
  std::int64_t delay = 0;   ///< [ns], from a sample to its output, mean
  std::int64_t jitter = 0;  ///< [ns], largest deviation of the delay, uniformly distributed
  std::uint32_t jitter_seed = 1;
  std::vector<std::string> measured;  ///< "rotor.x", the names in the scene
  std::vector<SignalSpec> measures;
  std::vector<std::string> acted_on;  ///< "rotor.force_x"
  std::vector<ActedInput> acts_on;
  SensorSettings sensor;  ///< for all measured signals
  std::uint32_t seed = 1;
  ActuatorSettings actuator;  ///< for all inputs acted on
  ParameterValues parameters;
  std::map<std::string, std::string> following;  ///< as SystemSpec::following
  Settings settings;

  // Of a controller of the speed of a shaft.
  std::vector<SpeedBand> critical_bands;  ///< bands that it avoids, besides those of its parameters
  std::vector<ResonancePassageCheck> weak_passages;  ///< on its way, in order
};

}  // namespace whirl_twin

// The controllers of a scene: what each measures, when, by which law, and what it acts on.
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

/// An input of a system, in the order of its dynamics.
struct ActedInput {
  std::size_t system = 0;  ///< of Scene::systems
  std::size_t input = 0;
};

/// A band of speeds through which a motor does not bring its rotor at a steady whirl.
struct WeakPassage {
  SpeedBand band;
  double speed = 0.0;   ///< [rad/s], where it lacks most
  double needed = 0.0;  ///< [N m], there; infinite where nothing damps the whirl
  double given = 0.0;   ///< [N m], there, at most
  bool tried = false;   ///< all the same: it is thrown through, or the scene wants it so
};

struct ControllerSpec {
  std::string name;
  std::string type;         ///< of controllerNames()
  double rate = 0.0;        ///< [Hz]; sample k at k / rate after simulated time 0
  std::int64_t delay = 0;   ///< [ns], from a sample to its output, on average
  std::int64_t jitter = 0;  ///< [ns], that it is more or less at most, evenly distributed
  std::uint32_t jitter_seed = 1;
  std::vector<std::string> measured;  ///< "rotor.x", as the scene names them
  std::vector<SignalSpec> measures;
  std::vector<std::string> acted_on;  ///< "rotor.force_x"
  std::vector<ActedInput> acts_on;
  SensorSettings sensor;  ///< of everything it measures
  std::uint32_t seed = 1;
  ActuatorSettings actuator;  ///< of everything it acts on
  ParameterValues parameters;
  std::map<std::string, std::string> following;  ///< as SystemSpec::following
  Settings settings;

  // Of one that brings a shaft to a speed.
  std::vector<SpeedBand> critical_bands;   ///< that it avoids, besides those of its parameters
  std::vector<WeakPassage> weak_passages;  ///< on its way, in their order
};

}  // namespace whirl_twin

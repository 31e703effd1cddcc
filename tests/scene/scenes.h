// Scenes for the tests of this folder: small, valid, and changed a key at a time.
#pragma once

#include <yaml-cpp/yaml.h>

#include <string>

#include "scene/scene_reader.h"

namespace whirl_twin {

inline Scene sceneOf(const std::string& yaml) {
  return readScene(YAML::Load(yaml), "test.yaml");
}

/// A rotor and a pendulum on one shaft that speeds up, and a double pendulum beside them.
inline const char* const kThreeSystems = R"(
name: three
step: 0.001
drives:
  shaft:
    speed: 5.0
    profile:
      - {speed: 12.0, max_acceleration: 20.0, max_jerk: 100.0, dwell: 0.2}
      - {speed: 3.0, max_acceleration: 30.0, dwell: 0.5}
systems:
  rotor:
    model: jeffcott_rotor
    drive: shaft
    parameters: {mass: 1.0, stiffness: 1.0e4, damping: 10.0, eccentricity: 1.0e-4}
  governor:
    model: spinning_pendulum
    drive: shaft
    parameters: {mass: 0.5, length: 0.2, damping: 0.01}
    initial: {theta: 0.4}
  arms:
    model: double_pendulum
    parameters: {mass1: 1.0, mass2: 2.0, length1: 1.0, length2: 0.5}
    initial: {theta1: 1.0, theta2: -0.5, theta2_rate: 2.0}
)";

/// Can be analysed and watched, but no step of a second can be prepared.
inline const char* const kUnsteppable = R"(
name: unsteppable
step: 1.0
drives: {shaft: {speed: 0.0, profile: [{speed: 3000.0, max_acceleration: 100.0}]}}
systems:
  rotor:
    model: jeffcott_rotor
    drive: shaft
    parameters: {mass: 1.0, stiffness: 1.0e4, damping: 5.0, internal_damping: 4.0, eccentricity: 1.0e-4}
    inputs: {force_x: 0.0}
)";

}  // namespace whirl_twin

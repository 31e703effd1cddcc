// The scene of a machine that is followed. A shaft that a motor turns has a motion that nobody
// knows who does not know its torque and its load; its pulses tell it. So where a keyphasor looks
// at it, what is followed is the rotor on a shaft that turns as measured: the same equations, with
// the shaft's angle, speed and acceleration given (free_spin.h less its last row).
#pragma once

#include <yaml-cpp/yaml.h>

#include <string>

#include "scene/scene.h"

namespace whirl_twin {

/// As readScene(), without the motors of shafts that a keyphasor looks at, without what acts on
/// them, and without controllers that act on them or measure their spin. Throws Refusal, also where
/// a sensor other than the keyphasor measures such a spin.
Scene readFollowedScene(const YAML::Node& scene, const std::string& source);
/// Of a file.
Scene readFollowedSceneFile(const std::string& path);

}  // namespace whirl_twin

// The scene of a state estimator. The motion of a motor-driven shaft follows from its torque and
// load, which are not known; its keyphasor measures it. For such a shaft the estimator uses the
// rotor on a shaft that turns as measured: the same equations with the shaft's angle, speed and
// acceleration prescribed (free_spin.h without its last row).
#pragma once

#include <yaml-cpp/yaml.h>

#include <string>

#include "scene/scene.h"

namespace whirl_twin {

/// As readScene(), without the motors of shafts with a keyphasor, the torque inputs on these
/// shafts, and controllers that act on them or measure their spin. Throws InputError, also where a
/// sensor other than the keyphasor measures such a spin.
Scene readEstimatorScene(const YAML::Node& scene, const std::string& source);
/// From a file.
Scene readEstimatorSceneFile(const std::string& path);

}  // namespace whirl_twin

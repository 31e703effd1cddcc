// Values of a scene's file that a command line replaces, as `--set rotor.damping=8`, before the
// scene is checked. Paths are those of studies (studies/scene_numbers.h), of any value:
//
//   rotor.damping, rotor.discs[0].mass          parameters of a system or a controller
//   rotor.initial.x, rotor.integrator           other keys of a system or a controller
//   shaft.speed, shaft.profile[1].speed         keys of a drive
//   shaft.max_acceleration                      of all its moves; likewise max_jerk and dwell
//   probes.noise                                keys of a sensor
//   step, gravity, systems.rotor.tolerance      full keys of the file
#pragma once

#include <yaml-cpp/yaml.h>

#include <string>
#include <utility>
#include <vector>

#include "scene/scene.h"

namespace whirl_twin {

/// A value, and the full keys of the places where it is put.
struct SceneChange {
  std::string given;  ///< "rotor.damping=8"
  std::vector<std::string> keys;
};

/// Applies "PATH=VALUE" in order. VALUE is a number with or without a unit, a name, or a list or
/// map in YAML. Throws InputError, "--set rotor.dampin=8: ...", for a path that leads nowhere.
std::vector<SceneChange> changeScene(YAML::Node& tree, const std::vector<std::string>& changes);

/// Puts a value, in place; a null one removes the key. Throws InputError, "rotor.dampin: ...".
void changeScene(YAML::Node& tree, const std::string& path, const YAML::Node& value);

/// As readScene(), of a tree that was changed: an error at a place of a change begins with it,
/// "--set rotor.damping=8 kg: systems.rotor.parameters.damping: ...".
Scene readChangedScene(const YAML::Node& tree, const std::string& source,
                       const std::vector<SceneChange>& changes);

/// The text of an error at a place of a change with the change in place of `source`.
std::string namedByChange(const std::string& error, const std::string& source,
                          const std::vector<SceneChange>& changes);

}  // namespace whirl_twin

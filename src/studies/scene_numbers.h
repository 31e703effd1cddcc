// The numbers of a scene's file that a study may vary, by their paths. A number stands in the tree
// of the file, or is left to its default there; to change it is to write it into the tree, and
// what reads scenes (scene_reader.h) does the rest: it checks, and fills in what hangs on it.
//
//   rotor.stiffness, rotor.bearings[0].kxx      parameters of a system, or of a controller
//   rotor.initial.x, rotor.initial.x_rate       where a system starts
//   rotor.speed                                 of a system without a drive
//   shaft.speed, shaft.profile[1].speed         keys of a drive
//   shaft.max_acceleration                      of all its moves; likewise max_jerk and dwell
//   systems.rotor.tolerance, gravity            any number that stands in the file, by its full key
#pragma once

#include <yaml-cpp/yaml.h>

#include <cstddef>
#include <map>
#include <string>
#include <variant>
#include <vector>

#include "scene/scene.h"

namespace whirl_twin {

/// Keys and places in lists, from the root of the tree.
using SceneNumber = std::vector<std::variant<std::string, std::size_t>>;

/// What a path stands for.
struct NamedNumber {
  std::vector<SceneNumber> places;  ///< one, or several that are varied together
  double value = 0.0;               ///< that the scene gives; NaN: of several, not one
  std::string unit = "-";
  /// Of a parameter that may not have any value: path in its system, and place of that in the scene
  std::string parameter = "";
  std::size_t system = 0;
};

/// All of them by their paths. The scene is the one that the tree is of.
std::map<std::string, NamedNumber> numbersOf(const YAML::Node& tree, const Scene& scene);

/// A tree that shares nothing with another, nor one of its parts with another (anchors).
YAML::Node separated(const YAML::Node& tree);

/// Writes a number there; maps on the way that are not there are made.
void put(YAML::Node tree, const SceneNumber& place, double value);

}  // namespace whirl_twin

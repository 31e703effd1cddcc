// Paths of the numbers in a scene's file that a study may vary. A number is in the tree of the
// file, or has its default value; it is changed by writing it into the tree, and the scene's reader
// (scene_reader.h) checks it and computes all that depends on it.
//
//   rotor.stiffness, rotor.bearings[0].kxx      parameters of a system or a controller
//   rotor.initial.x, rotor.initial.x_rate       initial state of a system
//   rotor.speed                                 of a system without a drive
//   shaft.speed, shaft.profile[1].speed         keys of a drive
//   shaft.max_acceleration                      of all its moves; likewise max_jerk and dwell
//   systems.rotor.tolerance, gravity            any number in the file, by its full key
#pragma once

#include <yaml-cpp/yaml.h>

#include <cstddef>
#include <map>
#include <string>
#include <variant>
#include <vector>

#include "scene/scene.h"

namespace whirl_twin {

/// Keys and list indices from the root of the tree.
using SceneNumber = std::vector<std::variant<std::string, std::size_t>>;

/// A number with a path.
struct NamedNumber {
  std::vector<SceneNumber> places;  ///< one, or several that are varied together
  double value = 0.0;               ///< nominal; NaN: several different ones
  std::string unit = "-";
  bool known = true;  ///< the unit; else it is that of the file, or "-"
  /// Of a parameter with a restricted range: path in its system, and index of that in the scene
  std::string parameter = "";
  std::size_t system = 0;
};

/// All numbers by path. The tree must be that of the scene.
std::map<std::string, NamedNumber> numbersOf(const YAML::Node& tree, const Scene& scene);

/// Writes a number at a place, with a unit unless it is ""; missing maps on the way are created.
void put(YAML::Node tree, const SceneNumber& place, double value, const std::string& unit = "");

}  // namespace whirl_twin

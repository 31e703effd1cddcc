// What a scene says, line by line, whichever way it came: to tell whether two are the same, and if
// not, in what.
#pragma once

#include <yaml-cpp/yaml.h>

#include <map>
#include <string>

#include "messages/scene_text.h"
#include "twin/twin.h"

namespace whirl_twin {

/// "systems.rotor.parameters.mass" to "2": numbers as the shortest text that is that number, in
/// whatever way they were written.
using SceneLines = std::map<std::string, std::string>;

/// Of a scene's YAML tree alone.
SceneLines sceneLines(const YAML::Node& tree);

/// A scene's YAML tree as the message that goes with a run; source: its file, for messages.
state::SceneText sceneText(const YAML::Node& tree, const std::string& source);

/// Of a scene's YAML tree, and of the twin that it made: its step, the order of what is in it, the
/// methods chosen, the tables of files that it names.
SceneLines sceneLines(const YAML::Node& tree, const Twin& twin);

}  // namespace whirl_twin

// Content of a scene line by line, independent of its notation: to find the differences between two
// scenes.
#pragma once

#include <yaml-cpp/yaml.h>

#include <map>
#include <string>

#include "messages/scene_text.h"
#include "twin/twin.h"

namespace whirl_twin {

/// "systems.rotor.parameters.mass" to "2": numbers as their shortest exact text, however they were
/// written.
using SceneLines = std::map<std::string, std::string>;

/// Of a scene's YAML tree only.
SceneLines sceneLines(const YAML::Node& tree);

/// A scene's YAML tree as the message published with a run; source: its file, for messages.
state::SceneText sceneText(const YAML::Node& tree, const std::string& source);

/// Of a scene's YAML tree and of the twin made from it: its step, the order of its elements, the
/// selected methods, the tables of its files.
SceneLines sceneLines(const YAML::Node& tree, const Twin& twin);

}  // namespace whirl_twin

// Reads and validates scene files. One parser serves the command line (a YAML file) and the nodes
// (the same file loaded into ROS parameters).
#pragma once

#include <yaml-cpp/yaml.h>

#include <string>

#include "scene/scene.h"
#include "scene/scene_error.h"

namespace whirl_twin {

/// The scene of a YAML file. Throws SceneError with every error found.
Scene readSceneFile(const std::string& path);

/// The scene of a YAML tree; `source` is its name in messages. Throws SceneError.
Scene readScene(const YAML::Node& tree, const std::string& source);

}  // namespace whirl_twin

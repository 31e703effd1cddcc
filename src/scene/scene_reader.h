// Reads and checks scene files. One parser serves the command line (a YAML file) and the nodes (the
// same file loaded into ROS parameters).
#pragma once

#include <yaml-cpp/yaml.h>

#include <stdexcept>
#include <string>
#include <vector>

#include "scene/scene.h"

namespace whirl_twin {

/// All errors of one scene, each "source: key: what was expected with its unit, what was found".
class SceneError : public std::runtime_error {
 public:
  explicit SceneError(std::vector<std::string> errors);
  const std::vector<std::string>& errors() const { return errors_; }

 private:
  std::vector<std::string> errors_;
};

/// The scene of a YAML file. Throws SceneError with every error found.
Scene readSceneFile(const std::string& path);

/// The scene of a YAML tree; `source` names it in messages. Throws SceneError.
Scene readScene(const YAML::Node& tree, const std::string& source);

}  // namespace whirl_twin

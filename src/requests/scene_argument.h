// SCENE and --set of a command: a scene file, one of the package by its name, or standard input,
// with values replaced.
#pragma once

#include <yaml-cpp/yaml.h>

#include <optional>
#include <string>
#include <vector>

#include "scene/scene.h"
#include "scene/scene_changes.h"

namespace whirl_twin {

struct SceneArgument {
  std::string name;                  ///< as given: a path, the name of a scene, "-"
  std::vector<std::string> changes;  ///< "rotor.damping=8"
};

/// The tree of a scene's file, with its changes. Read once: standard input ends.
class SceneTree {
 public:
  /// Throws SceneError, or InputError for a change that leads nowhere.
  explicit SceneTree(const SceneArgument& argument);

  const YAML::Node& tree() const { return tree_; }
  /// Its path, or "standard input": in messages and in logs.
  const std::string& source() const { return source_; }
  /// The path as an absolute one, for logs.
  std::string absoluteSource() const;
  /// Throws SceneError.
  Scene scene() const { return readChangedScene(tree_, source_, changes_); }
  /// As scene(), of a state estimator (estimation/estimator_scene.h).
  Scene estimatorScene() const;

 private:
  std::string source_;
  YAML::Node tree_;
  std::vector<SceneChange> changes_;
};

/// The scene, of a command that needs nothing of its file.
Scene sceneOf(const SceneArgument& argument);

}  // namespace whirl_twin

#include "requests/scene_argument.h"

#include <filesystem>

#include "estimation/estimator_scene.h"
#include "messages/input_error.h"
#include "requests/shipped_scenes.h"
#include "scene/scene_error.h"
#include "scene/yaml_file.h"

namespace whirl_twin {

SceneTree::SceneTree(const SceneArgument& argument) {
  const std::string path = scenePath(argument.name);
  source_ = path == "-" || path == "/dev/stdin" ? kStandardInput : path;
  try {
    tree_ = readYamlFile(path, "a scene", "a step and at least one system");
  } catch (const InputError& error) {
    throw SceneError({error.what()});
  }
  changes_ = changeScene(tree_, argument.changes);
}

std::string SceneTree::absoluteSource() const {
  return source_ == kStandardInput ? source_ : std::filesystem::absolute(source_).string();
}

Scene SceneTree::estimatorScene() const {
  try {
    return readEstimatorScene(tree_, source_);
  } catch (const SceneError& error) {
    std::vector<std::string> named;
    for (const std::string& one : error.errors()) {
      named.push_back(namedByChange(one, source_, changes_));
    }
    throw SceneError(named);
  }
}

Scene sceneOf(const SceneArgument& argument) {
  return SceneTree(argument).scene();
}

}  // namespace whirl_twin

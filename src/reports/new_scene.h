// A scene to begin with: what `twin new MODEL` writes.
#pragma once

#include <string>

#include "models/model_info.h"
#include "scene/yaml_file.h"

namespace whirl_twin {

/// A scene file of one system of the model, in which every key of it stands with its unit and what
/// it means: what the example gives is set, the rest is commented out with its default.
/// @param example  the tree of a scene, and `system` the name of one of this model in it; without
/// an
///                 example (an empty name) required numbers are 1
std::string newScene(const ModelInfo& model, const YAML::Node& example, const std::string& system);

}  // namespace whirl_twin

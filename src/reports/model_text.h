// The text for the parameters of models and controllers, and a first scene of a model, `twin new`.
#pragma once

#include <string>
#include <vector>

#include "models/model_info.h"
#include "reports/output.h"
#include "scene/yaml_file.h"

namespace whirl_twin {

/// A line each, of `twin models` and `twin controllers`; without: what one without a default is.
std::string parameterText(const ParameterInfo& parameter, const std::string& without = "required");
std::string settingText(const SettingInfo& setting);

/// {"unit", "range", "default", "required", "meaning"}
Json parameterJson(const ParameterInfo& parameter);
/// {"kind", "required", "meaning", "choices", "default", "columns"}
Json settingJson(const SettingInfo& setting);

/// "auto" and the methods that a form of a model can step with.
std::vector<std::string> integratorsOf(const ModelVariant& variant);

/// A scene file of one system of the model, in which every key has its unit and its
/// meaning as a comment: what the example gives is set, the rest is commented out with its default.
/// @param example  the tree of a scene, and `system` the name of one of this model in it; without
/// an
///                 example (an empty name) required numbers are 1
std::string newScene(const ModelInfo& model, const YAML::Node& example, const std::string& system);

}  // namespace whirl_twin

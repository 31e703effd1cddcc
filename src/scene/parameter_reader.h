// Reads the `parameters` of a system or a controller as declared by its model or control law:
// numbers with units and ranges, words, matrices, names and tables.
#pragma once

#include <map>
#include <string>
#include <vector>

#include "models/model_info.h"
#include "scene/node_reader.h"
#include "scene/scene.h"

namespace whirl_twin {

/// Fills spec.parameters, spec.settings and spec.speed; adds a diagnostic for every error.
void readParameters(const MapReader& system, const ModelInfo& model, SystemSpec& spec,
                    Diagnostics& diagnostics);

/// Reads the `parameters` of `owner`, whose values are `of` a model or a control law by this name;
/// `further` keys are allowed among them; `following` receives those that are not given and follow
/// another one. Adds a diagnostic for every error.
MapReader readParameterValues(const MapReader& owner, const std::string& of,
                              const std::vector<ParameterInfo>& parameters,
                              const std::vector<SettingInfo>& settings,
                              const std::vector<std::string>& further, ParameterValues& values,
                              std::map<std::string, std::string>& following, Settings& given,
                              Diagnostics& diagnostics);

}  // namespace whirl_twin

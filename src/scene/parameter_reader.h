// Reads a system's `parameters` as its model wants them, and a controller's as its law does:
// numbers with units and ranges, words, matrices, names and tables.
#pragma once

#include <map>
#include <string>
#include <vector>

#include "models/model_info.h"
#include "scene/node_reader.h"
#include "scene/scene.h"

namespace whirl_twin {

/// Fills spec.parameters, spec.settings and spec.speed; complains of everything that does not fit.
void readParameters(const MapReader& system, const ModelInfo& model, SystemSpec& spec,
                    Complaints& complaints);

/// The `parameters` of `owner`, whose values are `of` a model or a law by this name; `further` keys
/// may stand among them; `following` gets those that are not given and follow another. Complains
/// likewise.
MapReader readParameterValues(const MapReader& owner, const std::string& of,
                              const std::vector<ParameterInfo>& parameters,
                              const std::vector<SettingInfo>& settings,
                              const std::vector<std::string>& further, ParameterValues& values,
                              std::map<std::string, std::string>& following, Settings& given,
                              Complaints& complaints);

}  // namespace whirl_twin

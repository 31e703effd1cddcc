// Access to every number among the parameters of a system or a controller by its path: `damping`, a
// table's `bearings[0].kxx`, a matrix's `stiffness[0][1]`; rows and columns count from 0.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "controllers/controller_info.h"
#include "messages/states.h"
#include "models/model_info.h"
#include "scene/node_reader.h"
#include "scene/scene.h"

namespace whirl_twin {

/// Matrices with more entries have no paths: their sets of parameters would be too long to be
/// published at every change.
inline constexpr int kMaxMatrixEntries = 400;

/// All numbers with their values, in the order of the model; `changed` is empty.
state::ParameterChange parametersOf(const ModelInfo& model, const SystemSpec& spec);
state::ParameterChange parametersOf(const ControllerInfo& info, const ControllerSpec& spec);

/// The number at a path; nothing if there is none.
std::optional<double> parameterAt(const std::string& path, const ModelInfo& model,
                                  const SystemSpec& spec);
std::optional<double> parameterAt(const std::string& path, const ControllerInfo& info,
                                  const ControllerSpec& spec);

/// The unit of the number at a path, "-" if it has none; "" for an unknown path.
std::string unitAt(const std::string& path, const ModelInfo& model, const SystemSpec& spec);

/// Sets a number and those that follow it (SystemSpec::following, TableRow::following); it ceases
/// to follow another one. For an unknown path or a value out of range it returns false, changes
/// nothing, and adds a diagnostic under the key systems.NAME.parameters or
/// controllers.NAME.parameters, as for a scene file.
bool setParameter(const std::string& path, double value, const ModelInfo& model, SystemSpec& spec,
                  Diagnostics& diagnostics);
bool setParameter(const std::string& path, double value, const ControllerInfo& info,
                  ControllerSpec& spec, Diagnostics& diagnostics);

}  // namespace whirl_twin

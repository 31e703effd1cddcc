// Every number among the parameters of a system or a controller, by its path: `damping`, a table's
// `bearings[0].kxx`, a matrix's `stiffness[0][1]`; rows and columns count from 0.
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

/// Matrices of more entries than this have no paths: their sets of parameters would be too long to
/// be sent at every change.
inline constexpr int kMostMatrixEntries = 400;

/// All of them with their values, in the order of the model; nothing `changed`.
state::ParameterChange parametersOf(const ModelInfo& model, const SystemSpec& spec);
state::ParameterChange parametersOf(const ControllerInfo& info, const ControllerSpec& spec);

/// The number at a path; nothing if there is none.
std::optional<double> parameterAt(const std::string& path, const ModelInfo& model,
                                  const SystemSpec& spec);
std::optional<double> parameterAt(const std::string& path, const ControllerInfo& info,
                                  const ControllerSpec& spec);

/// The unit of the number at a path, "-" without; "" if there is none of that path.
std::string unitAt(const std::string& path, const ModelInfo& model, const SystemSpec& spec);

/// Sets a number and those that follow it (SystemSpec::following, TableRow::following); it follows
/// no other any more. Complains in the words of a scene file under the key systems.NAME.parameters
/// or controllers.NAME.parameters, and changes nothing, if there is none of that path or it is out
/// of range: false.
bool setParameter(const std::string& path, double value, const ModelInfo& model, SystemSpec& spec,
                  Complaints& complaints);
bool setParameter(const std::string& path, double value, const ControllerInfo& info,
                  ControllerSpec& spec, Complaints& complaints);

}  // namespace whirl_twin

// The controllers a scene can name.
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "controllers/controller_info.h"

namespace whirl_twin {

/// Where controllers come from that are not built in. It is asked once, and only when a name is
/// looked for that no built-in controller has, or when all are listed: so it is to be set before. A
/// controller that is incomplete, or whose name is taken, is left out and `warn` is told why.
void setControllerSource(std::function<std::vector<ControllerInfo>()> source,
                         std::function<void(const std::string&)> warn);

/// All controllers, sorted by name: asks the source.
const std::vector<ControllerInfo>& controllers();

/// The names of controllers().
std::vector<std::string> controllerNames();

/// The controller of that name, or nullptr. Valid for ever.
const ControllerInfo* findController(const std::string& name);

}  // namespace whirl_twin

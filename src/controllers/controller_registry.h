// The types of controller available in scenes.
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "controllers/controller_info.h"

namespace whirl_twin {

/// Source of controllers that are not built in. It is called once, and only when a name is not that
/// of a built-in controller, or when all are listed: hence it must be set before. A controller that
/// is incomplete, or whose name is a duplicate, is skipped and reported through `warn`.
void setControllerSource(std::function<std::vector<ControllerInfo>()> source,
                         std::function<void(const std::string&)> warn);

/// All controllers, sorted by name, including those of the source.
const std::vector<ControllerInfo>& controllers();

/// The names of controllers().
std::vector<std::string> controllerNames();

/// The controller of that name, or nullptr. Valid until the program ends.
const ControllerInfo* findController(const std::string& name);

}  // namespace whirl_twin

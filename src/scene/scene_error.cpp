#include "scene/scene_error.h"

#include <fmt/format.h>

#include <utility>

namespace whirl_twin {

SceneError::SceneError(std::vector<std::string> errors)
    : InputError(fmt::format("{}", fmt::join(errors, "\n"))), errors_(std::move(errors)) {}

}  // namespace whirl_twin

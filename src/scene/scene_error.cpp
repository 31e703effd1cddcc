#include "scene/scene_error.h"

#include <fmt/format.h>

#include <algorithm>
#include <utility>

#include "scene/error_list.h"

namespace whirl_twin {

std::string errorList(const std::vector<std::string>& errors, const std::string& between) {
  const std::size_t shown = std::min(errors.size(), kMaxErrorsShown);
  const std::string list = fmt::format(
      "{}", fmt::join(errors.begin(), errors.begin() + static_cast<long>(shown), between));
  return shown == errors.size()
             ? list
             : fmt::format("{}{}and {} more", list, between, errors.size() - shown);
}

SceneError::SceneError(std::vector<std::string> errors)
    : InputError(errorList(errors)), errors_(std::move(errors)) {}

}  // namespace whirl_twin

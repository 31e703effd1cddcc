// Which systems of a scene a command is about.
#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <vector>

#include "scene/scene.h"

namespace whirl_twin {

/// The system of that name, or all of them without a name: indices into scene.systems.
/// Throws Refusal with a hint.
std::vector<std::size_t> selectedSystems(const Scene& scene,
                                         const std::optional<std::string>& name);

}  // namespace whirl_twin

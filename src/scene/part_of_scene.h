// Reduces a scene to some of its systems.
#pragma once

#include <cstddef>
#include <vector>

#include "scene/scene.h"

namespace whirl_twin {

/// A scene of the systems with these indices, in this order, with all drives, and with those
/// sensors and controllers that refer to no other system.
Scene partOf(const Scene& scene, const std::vector<std::size_t>& systems);

}  // namespace whirl_twin

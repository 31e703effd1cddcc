// A scene with some of its systems only.
#pragma once

#include <cstddef>
#include <vector>

#include "scene/scene.h"

namespace whirl_twin {

/// The systems at these places, in this order, with all drives, and with those sensors and
/// controllers that have to do with no other system.
Scene partOf(const Scene& scene, const std::vector<std::size_t>& systems);

}  // namespace whirl_twin

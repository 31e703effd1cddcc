// Whether a system would go on with what it is to be given: it is stepped beside the loop, from the
// scene's start. What overflows, or grows by far too long a step, does so within a few steps.
#pragma once

#include <optional>
#include <string>

#include "scene/built_scene.h"

namespace whirl_twin {

/// Why `system`, one of the scene's as it is to be, would stop in the first 200 steps, on its drive
/// or at a constant speed [rad/s]; "" if it goes on. Throws RunFailure where its steps cannot be
/// prepared. A system with controllers is not tried: alone it moves otherwise.
std::string whyItWouldStop(const BuiltScene& scene, const BuiltSystem& system,
                           std::optional<double> speed = std::nullopt);

}  // namespace whirl_twin

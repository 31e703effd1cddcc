// Trial of a changed system: steps it outside the loop from the scene's start. An overflow, or the
// growth with a far too long step, shows within a few steps.
#pragma once

#include <optional>
#include <string>

#include "scene/built_scene.h"

namespace whirl_twin {

/// Why `system`, a changed one of the scene's, would stop in the first 200 steps, on its drive or
/// at a constant speed [rad/s]; "" if it continues. Throws RunFailure if its steps cannot be
/// prepared. Systems with controllers are not tried: without these they move differently.
std::string whyItWouldStop(const BuiltScene& scene, const BuiltSystem& system,
                           std::optional<double> speed = std::nullopt);

}  // namespace whirl_twin

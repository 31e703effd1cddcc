// A scene with its systems built, for all who ask and none who step: nothing in it depends on the
// scene's step, so a scene whose steps cannot be prepared is analysed and monitored like any other.
#pragma once

#include <cstddef>
#include <vector>

#include "control/drive.h"
#include "control/inputs.h"
#include "scene/built_system.h"
#include "scene/scene.h"

namespace whirl_twin {

struct BuiltScene {
  Scene scene;
  std::vector<SharedSystem> systems;  ///< in the scene's order

  /// Drives of the scene first, in its order; then those of systems at constant speed, all at the
  /// scene's start.
  std::vector<Drive> drives() const;
  /// The one that turns a system.
  Drive driveOf(const BuiltSystem& system) const;
  /// What acts on a system, at the scene's start.
  Inputs inputsOf(const BuiltSystem& system) const;
  double startSeconds() const { return static_cast<double>(scene.time) / 1.0e9; }  ///< [s]
};

/// Takes the setups that reading left in the scene, and makes only those anew whose specs were
/// changed since. Throws std::logic_error for a scene that readScene() would have refused.
BuiltScene build(const Scene& scene);

}  // namespace whirl_twin

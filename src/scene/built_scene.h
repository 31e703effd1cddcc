// A scene with its systems built, for analysis and monitoring: independent of the scene's step, so
// that a scene whose steps cannot be prepared is analysed and monitored like any other.
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

  /// First the drives of the scene, in its order; then those of systems at constant speed, all at
  /// the start of the scene.
  std::vector<Drive> drives() const;
  /// The drive of a system.
  Drive driveOf(const BuiltSystem& system) const;
  /// The inputs of a system, at the start of the scene.
  Inputs inputsOf(const BuiltSystem& system) const;
  double startSeconds() const { return static_cast<double>(scene.time) / 1.0e9; }  ///< [s]

  /// Names of the rotors, and those under which their further stations are published.
  struct RotorNames {
    std::vector<std::string> rotors, stations;
  };
  RotorNames rotorNames() const;
};

/// Uses the setups stored in the scene, and repeats only those whose specs were changed since.
/// Throws std::logic_error for a scene that readScene() would reject.
BuiltScene build(const Scene& scene);

}  // namespace whirl_twin

// What a scene surrounds a system with: its gravity, and the motor that turns it, if one does.
#pragma once

#include "models/model_info.h"
#include "scene/scene.h"

namespace whirl_twin {

inline Surroundings surroundingsOf(const Scene& scene, const SystemSpec& system) {
  Surroundings around(scene.gravity);
  const std::size_t drive = scene.driveOf(system);
  if (drive < scene.drives.size()) {
    around.motor = scene.drives[drive].motor;
  }
  return around;
}

}  // namespace whirl_twin

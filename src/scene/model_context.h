// The context of a system in a scene: gravity, and the motor of its drive, if it has one.
#pragma once

#include "models/model_info.h"
#include "scene/scene.h"

namespace whirl_twin {

inline ModelContext surroundingsOf(const Scene& scene, const SystemSpec& system) {
  ModelContext around(scene.gravity);
  const std::size_t drive = scene.driveOf(system);
  if (drive < scene.drives.size()) {
    around.motor = scene.drives[drive].motor;
  }
  return around;
}

}  // namespace whirl_twin

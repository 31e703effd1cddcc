#include "mechanics/pendulums/rotating_pendulum.h"

#include "scene/model_entry.h"
#include "scene/models/models.h"

namespace whirl_twin {

ModelInfo rotatingPendulumInfo() {
  return modelInfo<RotatingPendulum>();
}

}  // namespace whirl_twin

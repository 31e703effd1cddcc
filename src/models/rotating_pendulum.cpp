#include "mechanics/pendulums/rotating_pendulum.h"

#include "models/model_entry.h"
#include "models/models.h"

namespace whirl_twin {

ModelInfo rotatingPendulumInfo() {
  return modelInfo<RotatingPendulum>();
}

}  // namespace whirl_twin

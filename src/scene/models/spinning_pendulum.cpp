#include "mechanics/pendulums/spinning_pendulum.h"

#include "scene/model_entry.h"
#include "scene/models/models.h"

namespace whirl_twin {

ModelInfo spinningPendulumInfo() {
  return modelInfo<SpinningPendulum>();
}

}  // namespace whirl_twin

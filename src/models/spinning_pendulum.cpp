#include "mechanics/pendulums/spinning_pendulum.h"

#include "models/model_entry.h"
#include "models/models.h"

namespace whirl_twin {

ModelInfo spinningPendulumInfo() {
  return modelInfo<SpinningPendulum>();
}

}  // namespace whirl_twin

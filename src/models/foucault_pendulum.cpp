#include "mechanics/pendulums/foucault_pendulum.h"

#include "models/model_entry.h"
#include "models/models.h"

namespace whirl_twin {

ModelInfo foucaultPendulumInfo() {
  return modelInfo<FoucaultPendulum>();
}

}  // namespace whirl_twin

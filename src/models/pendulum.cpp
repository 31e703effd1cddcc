#include "mechanics/pendulums/pendulum.h"

#include "models/model_entry.h"
#include "models/models.h"

namespace whirl_twin {

ModelInfo pendulumInfo() {
  return modelInfo<Pendulum>();
}

}  // namespace whirl_twin

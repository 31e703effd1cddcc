#include "mechanics/pendulums/kapitza_pendulum.h"

#include "models/model_entry.h"
#include "models/models.h"

namespace whirl_twin {

ModelInfo kapitzaPendulumInfo() {
  return modelInfo<KapitzaPendulum>();
}

}  // namespace whirl_twin

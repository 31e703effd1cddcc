#include "mechanics/pendulums/double_pendulum.h"

#include "scene/model_entry.h"
#include "scene/models/models.h"

namespace whirl_twin {

ModelInfo doublePendulumInfo() {
  return modelInfo<DoublePendulum>();
}

}  // namespace whirl_twin

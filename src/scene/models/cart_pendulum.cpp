#include "mechanics/pendulums/cart_pendulum.h"

#include "scene/model_entry.h"
#include "scene/models/models.h"

namespace whirl_twin {

ModelInfo cartPendulumInfo() {
  return modelInfo<CartPendulum>();
}

}  // namespace whirl_twin

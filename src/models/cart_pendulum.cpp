#include "mechanics/pendulums/cart_pendulum.h"

#include "models/model_entry.h"
#include "models/models.h"

namespace whirl_twin {

ModelInfo cartPendulumInfo() {
  return modelInfo<CartPendulum>();
}

}  // namespace whirl_twin

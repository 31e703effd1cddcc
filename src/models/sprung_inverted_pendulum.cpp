#include "mechanics/pendulums/sprung_inverted_pendulum.h"

#include "models/model_entry.h"
#include "models/models.h"

namespace whirl_twin {

ModelInfo sprungInvertedPendulumInfo() {
  return modelInfo<SprungInvertedPendulum>();
}

}  // namespace whirl_twin

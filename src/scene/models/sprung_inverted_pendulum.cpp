#include "mechanics/pendulums/sprung_inverted_pendulum.h"

#include "scene/model_entry.h"
#include "scene/models/models.h"

namespace whirl_twin {

ModelInfo sprungInvertedPendulumInfo() {
  return modelInfo<SprungInvertedPendulum>();
}

}  // namespace whirl_twin

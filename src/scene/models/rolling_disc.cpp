#include "mechanics/oscillators/rolling_disc.h"

#include "scene/model_entry.h"
#include "scene/models/models.h"

namespace whirl_twin {

ModelInfo rollingDiscInfo() {
  return modelInfo<RollingDisc>();
}

}  // namespace whirl_twin

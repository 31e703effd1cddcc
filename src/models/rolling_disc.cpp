#include "mechanics/oscillators/rolling_disc.h"

#include "models/model_entry.h"
#include "models/models.h"

namespace whirl_twin {

ModelInfo rollingDiscInfo() {
  return modelInfo<RollingDisc>();
}

}  // namespace whirl_twin

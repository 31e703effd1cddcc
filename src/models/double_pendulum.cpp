#include "mechanics/pendulums/double_pendulum.h"

#include "mechanics/pendulums/relative_double_pendulum.h"
#include "models/model_entry.h"
#include "models/models.h"

namespace whirl_twin {

ModelInfo doublePendulumInfo() {
  ModelInfo info = modelInfo<DoublePendulum>();
  addVariant<RelativeDoublePendulum>(info, "coordinates", "absolute", "relative",
                                     "the lower angle from the vertical, or from the upper rod");
  return info;
}

}  // namespace whirl_twin

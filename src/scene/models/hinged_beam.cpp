#include "mechanics/oscillators/hinged_beam.h"

#include "mechanics/oscillators/small_hinged_beam.h"
#include "scene/model_entry.h"
#include "scene/models/models.h"

namespace whirl_twin {

ModelInfo hingedBeamInfo() {
  ModelInfo info = modelInfo<HingedBeam>();
  addVariant<SmallHingedBeam>(info, "geometry", "finite", "small",
                              "finite rotation, or small as in the lecture notes");
  return info;
}

}  // namespace whirl_twin

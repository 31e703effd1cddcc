#include "mechanics/rotors/sliding_mass_flywheel.h"

#include "models/model_entry.h"
#include "models/models.h"

namespace whirl_twin {

ModelInfo slidingMassFlywheelInfo() {
  ModelInfo info = modelInfo<SlidingMassFlywheel>();
  addVariant<SymmetricSlidingMassFlywheel>(info, "symmetric", "false", "true",
                                           "both masses at one radius: two degrees of freedom");
  return info;
}

}  // namespace whirl_twin

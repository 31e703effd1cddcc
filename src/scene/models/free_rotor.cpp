#include "mechanics/rotors/free_rotor.h"

#include "scene/model_entry.h"
#include "scene/models/models.h"

namespace whirl_twin {

ModelInfo freeRotorInfo() {
  return modelInfo<FreeRotor>();
}

}  // namespace whirl_twin

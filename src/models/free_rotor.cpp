#include "mechanics/rotors/free_rotor.h"

#include "models/model_entry.h"
#include "models/models.h"

namespace whirl_twin {

ModelInfo freeRotorInfo() {
  return modelInfo<FreeRotor>();
}

}  // namespace whirl_twin

#include "mechanics/rotors/jeffcott_rotor.h"

#include "scene/model_entry.h"
#include "scene/models/models.h"

namespace whirl_twin {

ModelInfo jeffcottRotorInfo() {
  return modelInfo<JeffcottRotor>();
}

}  // namespace whirl_twin

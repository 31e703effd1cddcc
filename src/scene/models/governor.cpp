#include "mechanics/rotors/governor.h"

#include "scene/model_entry.h"
#include "scene/models/models.h"

namespace whirl_twin {

ModelInfo governorInfo() {
  return modelInfo<Governor>();
}

}  // namespace whirl_twin

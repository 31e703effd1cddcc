#include "mechanics/rotors/governor.h"

#include "models/model_entry.h"
#include "models/models.h"

namespace whirl_twin {

ModelInfo governorInfo() {
  return modelInfo<Governor>();
}

}  // namespace whirl_twin

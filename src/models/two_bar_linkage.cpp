#include "mechanics/oscillators/two_bar_linkage.h"

#include "models/model_entry.h"
#include "models/models.h"

namespace whirl_twin {

ModelInfo twoBarLinkageInfo() {
  return modelInfo<TwoBarLinkage>();
}

}  // namespace whirl_twin

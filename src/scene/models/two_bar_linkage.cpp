#include "mechanics/oscillators/two_bar_linkage.h"

#include "scene/model_entry.h"
#include "scene/models/models.h"

namespace whirl_twin {

ModelInfo twoBarLinkageInfo() {
  return modelInfo<TwoBarLinkage>();
}

}  // namespace whirl_twin

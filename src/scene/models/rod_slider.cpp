#include "mechanics/pendulums/rod_slider.h"

#include "scene/model_entry.h"
#include "scene/models/models.h"

namespace whirl_twin {

ModelInfo rodSliderInfo() {
  return modelInfo<RodSlider>();
}

}  // namespace whirl_twin

#include "mechanics/pendulums/rod_slider.h"

#include "models/model_entry.h"
#include "models/models.h"

namespace whirl_twin {

ModelInfo rodSliderInfo() {
  return modelInfo<RodSlider>();
}

}  // namespace whirl_twin

#include "mechanics/oscillators/friction_oscillator.h"

#include "mechanics/oscillators/regularized_friction_oscillator.h"
#include "scene/model_entry.h"
#include "scene/models/models.h"

namespace whirl_twin {

ModelInfo frictionOscillatorInfo() {
  ModelInfo info = modelInfo<FrictionOscillator>();
  addVariant<RegularizedFrictionOscillator>(info, "regularization > 0",
                                            [](const ParameterValues& values, const Settings&) {
                                              return values.at("regularization") > 0.0;
                                            });
  info.setUp = [plain = info.setUp](const ParameterValues& values, const Settings& settings,
                                    double gravity) {
    if (values.at("half_spacing") == values.at("friction_coefficient") * values.at("height")) {
      throw SetupError("half_spacing",
                       "must not equal friction_coefficient x height: there the plank is about to "
                       "tip and its frequency infinite");
    }
    return plain(values, settings, gravity);
  };
  return info;
}

}  // namespace whirl_twin

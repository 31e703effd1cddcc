#include "mechanics/oscillators/friction_oscillator.h"

#include <cmath>

#include "models/model_entry.h"
#include "models/models.h"

namespace whirl_twin {

ModelInfo frictionOscillatorInfo() {
  ModelInfo info = modelInfo<StickingFrictionOscillator>();
  addVariant<FrictionOscillator>(
      info, "friction", "sticking", "sliding",
      "whether the plank can stick to a roller, or always slides on both, which is linear");
  addVariant<RegularizedFrictionOscillator>(info, "regularization > 0",
                                            [](const ParameterValues& values, const Settings&) {
                                              return values.at("regularization") > 0.0;
                                            });
  info.setUp = [plain = info.setUp](const ParameterValues& values, const Settings& settings,
                                    const ModelContext& around) {
    const double half = values.at("half_spacing");
    const double reach = half - values.at("friction_coefficient") * values.at("height");
    if (std::fabs(reach) <= 4.0e-16 * half) {  // no more than rounding
      throw SetupError("half_spacing",
                       "must not equal friction_coefficient x height, where the plank tips and its "
                       "frequency is infinite");
    }
    return plain(values, settings, around);
  };
  return info;
}

}  // namespace whirl_twin

#include "mechanics/oscillators/mass_spring_damper.h"

#include "models/model_entry.h"
#include "models/models.h"

namespace whirl_twin {

ModelInfo massSpringDamperInfo() {
  ModelInfo info = modelInfo<MassSpringDamper>();
  addVariant<RubbingMassSpringDamper>(info, "friction_force > 0",
                                      [](const ParameterValues& values, const Settings&) {
                                        return values.at("friction_force") > 0.0;
                                      });
  return info;
}

}  // namespace whirl_twin

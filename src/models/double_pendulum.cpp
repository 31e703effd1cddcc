#include "mechanics/pendulums/double_pendulum.h"

#include "mechanics/pendulums/double_pendulum_forms.h"
#include "models/model_entry.h"
#include "models/models.h"

namespace whirl_twin {

namespace {

bool hasMotors(const ParameterValues& values, const Settings&) {
  return values.at("motor_inertia1") != 0.0 || values.at("motor_inertia2") != 0.0;
}

bool hasDrag(const ParameterValues& values, const Settings&) {
  return values.at("drag1") != 0.0 || values.at("drag2") != 0.0;
}

bool isRelative(const Settings& settings) {
  const auto found = settings.choices.find("coordinates");
  return found != settings.choices.end() && found->second == "relative";
}

void requireRelative(const Settings& settings) {
  if (!isRelative(settings)) {
    throw SetupError("motor_inertia1", "motors at the joints need coordinates: relative");
  }
}

}  // namespace

ModelInfo doublePendulumInfo() {
  ModelInfo info = modelInfo<DoublePendulum>();
  addVariant<DraggedDoublePendulum>(info, "drag1 or drag2 > 0", hasDrag);
  addVariant<RelativeDoublePendulum>(info, "coordinates", "absolute", "relative",
                                     "the lower angle from the vertical, or from the upper rod");
  addVariant<MotorDoublePendulum>(info, "motor_inertia1 or motor_inertia2 > 0",
                                  [](const ParameterValues& values, const Settings& settings) {
                                    return hasMotors(values, settings) ||
                                           (isRelative(settings) && hasDrag(values, settings));
                                  });
  info.setUp = [plain = info.setUp](const ParameterValues& values, const Settings& settings,
                                    const ModelContext& around) {
    if (hasMotors(values, settings)) {
      requireRelative(settings);
    }
    return plain(values, settings, around);
  };
  return info;
}

}  // namespace whirl_twin

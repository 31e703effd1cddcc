// State feedback by a given gain: u = -gain (y - setpoint), y all measured quantities at the
// sampling instant.
#include "controllers/controller_settings.h"
#include "controllers/controllers.h"
#include "controllers/state_space_controller.h"

namespace whirl_twin {

namespace {

std::unique_ptr<Controller> makeStateFeedback(const ParameterValues&, const Settings& settings,
                                              const ControllerPlan& plan) {
  const Eigen::MatrixXd& gain = settings.matrices.at("gain");
  requireSize("gain", gain, static_cast<Eigen::Index>(plan.outputs),
              static_cast<Eigen::Index>(plan.measured),
              "a row per output, a column per measured signal");
  return std::make_unique<StateSpaceController>(staticLaw(-gain), setpointOf(settings, plan));
}

}  // namespace

ControllerInfo stateFeedbackInfo() {
  ControllerInfo info;
  info.name = "state_feedback";
  info.summary = "state feedback: a gain on the measured signals";
  info.settings = {{"gain", SettingKind::kMatrix, "output/measured",
                    "a row per output, a column per measured signal; negative feedback"},
                   setpointSetting()};
  info.settings[0].required = true;
  info.make = makeStateFeedback;
  return info;
}

}  // namespace whirl_twin

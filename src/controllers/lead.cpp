// A lead or lag compensator for each pair of measured quantity and output,
//
//   u = -gain (1 + s / zero) / (1 + s / pole) (y - setpoint),
//
// discretized by Tustin's rule, which keeps the imaginary axis on the unit circle. It leads where
// the zero is below the pole, most at sqrt(zero pole).
#include <fmt/format.h>

#include "algebra/constants.h"
#include "control/transfer_function.h"
#include "controllers/controller_settings.h"
#include "controllers/controllers.h"
#include "controllers/state_space_controller.h"

namespace whirl_twin {

namespace {

std::unique_ptr<Controller> makeLead(const ParameterValues& values, const Settings&,
                                     const ControllerPlan& plan) {
  requireAxes(plan, "gain");
  const double prewarp = values.at("prewarp");
  if (!(prewarp < kPi * plan.rate)) {
    throw SetupError("prewarp", fmt::format("must be < {:.6g} rad/s, half of the rate, found {}",
                                            kPi * plan.rate, prewarp));
  }
  const auto axes = static_cast<Eigen::Index>(plan.outputs);
  return std::make_unique<StateSpaceController>(
      onEachAxis(discreteLead(-values.at("gain"), values.at("zero"), values.at("pole"),
                              1.0 / plan.rate, prewarp),
                 axes),
      Eigen::VectorXd::Constant(axes, values.at("setpoint")));
}

}  // namespace

ControllerInfo leadInfo() {
  ControllerInfo info;
  info.name = "lead";
  info.summary = "lead or lag, axis by axis";
  info.parameters = {
      {"gain", "output/measured", Range::kAny, "static gain", std::nullopt, ""},
      {"zero", "rad/s", Range::kPositive, "below the pole it leads", std::nullopt, ""},
      {"pole", "rad/s", Range::kPositive, "below the zero it lags", std::nullopt, ""},
      {"prewarp", "rad/s", Range::kNotNegative,
       "frequency at which the discrete law equals the continuous one; 0: none", 0.0, ""},
      {"setpoint", "measured", Range::kAny, "of the measured signal", 0.0, ""},
  };
  info.make = makeLead;
  return info;
}

}  // namespace whirl_twin

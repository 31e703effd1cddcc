// A linear-quadratic regulator: the state feedback u = -K (x - setpoint) that minimizes
//
//   integral of  x' q x + u' r u
//
// for the plant linearized about its initial state. `cost: sampled` evaluates the integral exactly
// for zero-order-held outputs; `continuous` gives the gain of the continuous-time regulator, which
// is close to it only for short sampling periods. Neither includes a delay: the gain is that of
// outputs that act at their sampling instant.
#include <fmt/format.h>

#include "algebra/dense.h"
#include "controllers/controller_settings.h"
#include "controllers/controllers.h"
#include "controllers/quadratic_settings.h"
#include "controllers/state_space_controller.h"

namespace whirl_twin {

namespace {

using Eigen::MatrixXd;

std::unique_ptr<Controller> makeLqr(const ParameterValues&, const Settings& settings,
                                    const ControllerPlan& plan) {
  const LinearPlant& plant = plantOf(plan);
  const PivotedQr measured(plant.c);
  if (plant.c.rows() != plant.a.rows() || measured.rank() < plant.c.cols()) {
    throw SetupError("q", fmt::format("an lqr must measure all {} states, found {} signals with {} "
                                      "states; lqg estimates the others",
                                      plant.a.rows(), plant.c.rows(), measured.rank()));
  }
  const MatrixXd gain = regulatorGain(settings, plant, plan.rate);
  return std::make_unique<StateSpaceController>(staticLaw(-gain * Lu(plant.c).inverse()),
                                                setpointOf(settings, plan));
}

}  // namespace

ControllerInfo lqrInfo() {
  ControllerInfo info;
  info.name = "lqr";
  info.summary = "linear-quadratic regulator: state feedback of minimum cost";
  info.settings = regulatorSettings();
  info.settings.push_back(setpointSetting());
  info.make = makeLqr;
  return info;
}

}  // namespace whirl_twin

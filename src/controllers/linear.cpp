// Any linear discrete-time controller, y the measurement minus its set-point: by matrices,
//
//   x(k + 1) = a x(k) + b y(k),   u(k) = c x(k) + d y(k),   x(0) = 0,
//
// or axis by axis by a transfer function in z, u = (numerator / denominator) y. No sign is
// inverted: negative feedback needs negative gains.
#include <fmt/format.h>

#include "control/transfer_function.h"
#include "controllers/controller_settings.h"
#include "controllers/controllers.h"
#include "controllers/state_space_controller.h"

namespace whirl_twin {

namespace {

using Eigen::Index;
using Eigen::MatrixXd;

DiscreteStateSpace byMatrices(const Settings& settings, const ControllerPlan& plan) {
  const auto measured = static_cast<Index>(plan.measured);
  const auto outputs = static_cast<Index>(plan.outputs);
  const MatrixXd* a = givenMatrix(settings, "a");
  const Index states = a != nullptr ? a->rows() : 0;
  DiscreteStateSpace law = staticLaw(MatrixXd::Zero(outputs, measured));
  const auto take = [&](const char* name, MatrixXd& place, Index rows, Index columns,
                        const char* why) {
    const MatrixXd* given = givenMatrix(settings, name);
    if (given == nullptr) {
      throw SetupError(name, "missing; a, b and c must be given together");
    }
    requireSize(name, *given, rows, columns, why);
    place = *given;
  };
  if (a != nullptr) {
    take("a", law.a, states, states, "a row and a column per state");
    take("b", law.b, states, measured, "a row per state, a column per measured signal");
    take("c", law.c, outputs, states, "a row per output, a column per state");
  } else {
    for (const char* name : {"b", "c"}) {
      if (givenMatrix(settings, name) != nullptr) {
        throw SetupError("a",
                         fmt::format("missing; a, b and c must be given together, found {}", name));
      }
    }
  }
  if (const MatrixXd* d = givenMatrix(settings, "d"); d != nullptr) {
    requireSize("d", *d, outputs, measured, "a row per output, a column per measured signal");
    law.d = *d;
  } else if (a == nullptr) {
    throw SetupError(
        "d",
        "missing; a linear control law needs d, or a, b, c and d, or numerator and denominator");
  }
  return law;
}

DiscreteStateSpace byTransferFunction(const Settings& settings, const ControllerPlan& plan) {
  for (const char* name : {"a", "b", "c", "d"}) {
    if (givenMatrix(settings, name) != nullptr) {
      throw SetupError(name, "must not be given with numerator and denominator");
    }
  }
  const auto row = [&](const char* name) {
    const MatrixXd* given = givenMatrix(settings, name);
    if (given == nullptr) {
      throw SetupError(name, "missing; numerator and denominator must be given together");
    }
    requireSize(name, *given, 1, given->cols(), "coefficients of falling powers of z");
    return Eigen::VectorXd(given->row(0).transpose());
  };
  const Eigen::VectorXd numerator = row("numerator");
  const Eigen::VectorXd denominator = row("denominator");
  if (denominator[0] == 0.0) {
    throw SetupError("denominator", "the first number must not be 0, found 0");
  }
  if (numerator.size() > denominator.size()) {
    throw SetupError(
        "numerator",
        fmt::format(
            "must have at most {} coefficients, as the denominator has (causality), found {}",
            denominator.size(), numerator.size()));
  }
  requireAxes(plan, "numerator");
  return onEachAxis(discreteTransferFunction(numerator, denominator),
                    static_cast<Index>(plan.outputs));
}

std::unique_ptr<Controller> makeLinear(const ParameterValues&, const Settings& settings,
                                       const ControllerPlan& plan) {
  const bool transfer_function = givenMatrix(settings, "numerator") != nullptr ||
                                 givenMatrix(settings, "denominator") != nullptr;
  return std::make_unique<StateSpaceController>(
      transfer_function ? byTransferFunction(settings, plan) : byMatrices(settings, plan),
      setpointOf(settings, plan));
}

}  // namespace

ControllerInfo linearInfo() {
  const auto matrix = [](const char* name, const char* unit, const char* meaning) {
    return SettingInfo{name, SettingKind::kMatrix, unit, meaning};
  };
  ControllerInfo info;
  info.name = "linear";
  info.summary =
      "any discrete linear control law, by matrices or axis by axis by a transfer function in z";
  info.settings = {
      matrix("a", "-", "from its states to the next ones; default none"),
      matrix("b", "state/measured", "from the measured signals to the next states"),
      matrix("c", "output/state", "from its states to the outputs"),
      matrix("d", "output/measured", "from the measured signals to the outputs; default 0 with a"),
      matrix("numerator", "output/measured", "a row of coefficients of falling powers of z"),
      matrix("denominator", "-", "coefficients likewise, as many or more"),
      setpointSetting(),
  };
  info.make = makeLinear;
  return info;
}

}  // namespace whirl_twin

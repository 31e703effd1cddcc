#include "controllers/controller_settings.h"

#include <fmt/format.h>

namespace whirl_twin {

using Eigen::Index;
using Eigen::MatrixXd;

const MatrixXd* givenMatrix(const Settings& settings, const std::string& name) {
  const auto found = settings.matrices.find(name);
  return found == settings.matrices.end() ? nullptr : &found->second;
}

void requireSize(const std::string& name, const MatrixXd& matrix, Index rows, Index columns,
                 const std::string& why) {
  if (matrix.rows() != rows || matrix.cols() != columns) {
    throw SetupError(name, fmt::format("must be {} x {}, {}, found {} x {}", rows, columns, why,
                                       matrix.rows(), matrix.cols()));
  }
}

void requireAxes(const ControllerPlan& plan, const std::string& name) {
  if (plan.measured != plan.outputs) {
    throw SetupError(name, fmt::format("acts axis by axis: must have as many measured signals as "
                                       "outputs, found {} measured, {} acted on",
                                       plan.measured, plan.outputs));
  }
}

SettingInfo setpointSetting() {
  return {"setpoint", SettingKind::kMatrix, "of the measured signals",
          "a row with a number for each measured signal; default 0"};
}

Eigen::VectorXd setpointOf(const Settings& settings, const ControllerPlan& plan) {
  const auto measured = static_cast<Index>(plan.measured);
  const MatrixXd* given = givenMatrix(settings, "setpoint");
  if (given == nullptr) {
    return Eigen::VectorXd::Zero(measured);
  }
  requireSize("setpoint", *given, 1, measured, "a number for each measured signal");
  return given->row(0).transpose();
}

}  // namespace whirl_twin

// Reading of the settings of controllers, with errors reported at the setting concerned.
#pragma once

#include <Eigen/Core>
#include <string>

#include "controllers/controller_info.h"

namespace whirl_twin {

/// The matrix of that name, or nullptr where none is given.
const Eigen::MatrixXd* givenMatrix(const Settings& settings, const std::string& name);

/// Throws SetupError unless a matrix has this size; why: "a row each output, a column a state".
void requireSize(const std::string& name, const Eigen::MatrixXd& matrix, Eigen::Index rows,
                 Eigen::Index columns, const std::string& why);

/// Throws SetupError, at a parameter or setting, unless the numbers of measurements and outputs
/// agree.
void requireAxes(const ControllerPlan& plan, const std::string& name);

/// `setpoint`: a row of one number for each measured quantity.
SettingInfo setpointSetting();
/// 0 for each where it is not given. Throws SetupError for another size.
Eigen::VectorXd setpointOf(const Settings& settings, const ControllerPlan& plan);

}  // namespace whirl_twin

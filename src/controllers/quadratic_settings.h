// Settings common to linear-quadratic regulators: weights, and the kind of cost integral.
#pragma once

#include <Eigen/Core>
#include <functional>
#include <vector>

#include "controllers/controller_info.h"

namespace whirl_twin {

/// q, r and cost.
std::vector<SettingInfo> regulatorSettings();

/// The plant, which is required for a gain. Throws SetupError, at q.
const LinearPlant& plantOf(const ControllerPlan& plan);

/// A symmetric matrix [n x n] of weights, given in full or as a row of its diagonal. Throws
/// SetupError for another size, one that is not symmetric, or a diagonal number below 0.
Eigen::MatrixXd weightOf(const Settings& settings, const std::string& name, Eigen::Index n,
                         const std::string& of);

/// The optimal gain on the states [outputs x n]. Throws SetupError.
Eigen::MatrixXd regulatorGain(const Settings& settings, const LinearPlant& plant, double rate);

/// The result of `find`; its errors become a SetupError at this setting.
Eigen::MatrixXd foundFor(const std::string& setting, const std::function<Eigen::MatrixXd()>& find);

}  // namespace whirl_twin

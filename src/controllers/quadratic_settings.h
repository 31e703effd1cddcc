// The settings that regulators of least cost share: weights, and over what time the cost is
// counted.
#pragma once

#include <Eigen/Core>
#include <functional>
#include <vector>

#include "controllers/controller_info.h"

namespace whirl_twin {

/// q, r and cost.
std::vector<SettingInfo> regulatorSettings();

/// The plant, without which no gain is found. Throws SetupError, at q.
const LinearPlant& plantOf(const ControllerPlan& plan);

/// A symmetric matrix [n x n] of weights, given as such or by a row of its diagonal. Throws
/// SetupError for another size, one that is not symmetric, or a diagonal number below 0.
Eigen::MatrixXd weightOf(const Settings& settings, const std::string& name, Eigen::Index n,
                         const std::string& of);

/// The gain of least cost on the states [outputs x n]. Throws SetupError.
Eigen::MatrixXd regulatorGain(const Settings& settings, const LinearPlant& plant, double rate);

/// What `find` gives; what it refuses or fails with is a SetupError at this setting.
Eigen::MatrixXd foundFor(const std::string& setting, const std::function<Eigen::MatrixXd()>& find);

}  // namespace whirl_twin

// The matrices that a scene gives for a linear system, checked: what is not as it must be is a
// SetupError that names the matrix and the entry.
#pragma once

#include <Eigen/Core>
#include <string>
#include <vector>

#include "models/settings.h"

namespace whirl_twin {

/// A symmetric or skew-symmetric n x n matrix, without the rounding that its maker may have left
/// (1e-12 of its largest entry); zero if the scene does not give it. Throw SetupError.
Eigen::MatrixXd symmetricMatrix(const Settings& settings, const std::string& name, Eigen::Index n);
Eigen::MatrixXd skewMatrix(const Settings& settings, const std::string& name, Eigen::Index n);

/// Throws SetupError unless a symmetric mass matrix [kg] is positive definite; the names are those
/// of its coordinates.
void requirePositiveDefinite(const Eigen::MatrixXd& mass, const std::vector<std::string>& names);

/// Is a symmetric mass matrix positive definite, by more than rounding?
bool hasMassInEveryMotion(const Eigen::MatrixXd& mass);

}  // namespace whirl_twin

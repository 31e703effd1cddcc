// Vectors and matrices in JSON; negative zeros, of skew matrices and undamped modes, are zeros.
#pragma once

#include <Eigen/Core>
#include <vector>

#include "reports/output.h"

namespace whirl_twin {

Json arrayJson(const std::vector<double>& x);
Json arrayJson(const Eigen::VectorXd& x);
/// Row by row.
Json matrixJson(const Eigen::MatrixXd& m);

}  // namespace whirl_twin

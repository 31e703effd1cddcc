// The matrices of small deviations.
#pragma once

#include <Eigen/Core>

namespace whirl_twin {

/// M q'' + (C + G) q' + (K + N) q = 0 for small deviations; C, K symmetric, G, N skew. [n x n]
struct Linearization {
  Eigen::MatrixXd mass, damping, gyroscopic, stiffness, circulatory;
};

}  // namespace whirl_twin

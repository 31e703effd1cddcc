// A matrix as rows of a report.
#pragma once

#include <Eigen/Core>
#include <string>

namespace whirl_twin {

/// As many coordinates are shown one by one, with their matrices.
inline constexpr int kFewCoordinates = 6;

/// Indented, the title before the first row; a zero matrix is one 0.
std::string matrixText(const char* title, const Eigen::MatrixXd& m);

}  // namespace whirl_twin

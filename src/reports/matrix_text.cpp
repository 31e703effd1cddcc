#include "reports/matrix_text.h"

#include <fmt/format.h>

#include <cmath>

namespace whirl_twin {

namespace {

/// Rounding beside the largest of its row and of its column, which may be in other units.
bool isNoise(const Eigen::MatrixXd& m, Eigen::Index i, Eigen::Index j) {
  constexpr double kRounding = 1.0e-14;
  return std::fabs(m(i, j)) <= kRounding * std::sqrt(m.row(i).cwiseAbs().maxCoeff()) *
                                   std::sqrt(m.col(j).cwiseAbs().maxCoeff());
}

}  // namespace

std::string matrixText(const char* title, const Eigen::MatrixXd& m) {
  if (m.isZero(0.0)) {
    return fmt::format("    {:<15} 0\n", title);
  }
  std::string out;
  for (Eigen::Index i = 0; i < m.rows(); ++i) {
    out += fmt::format("    {:<15}", i == 0 ? title : "");
    for (Eigen::Index j = 0; j < m.cols(); ++j) {
      out += fmt::format(" {:>13.6g}", isNoise(m, i, j) ? 0.0 : m(i, j) + 0.0);
    }
    out += "\n";
  }
  return out;
}

}  // namespace whirl_twin

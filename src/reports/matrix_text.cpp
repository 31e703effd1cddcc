#include "reports/matrix_text.h"

#include <fmt/format.h>

namespace whirl_twin {

std::string matrixText(const char* title, const Eigen::MatrixXd& m) {
  if (m.isZero(0.0)) {
    return fmt::format("    {:<15} 0\n", title);
  }
  std::string out;
  for (Eigen::Index i = 0; i < m.rows(); ++i) {
    out += fmt::format("    {:<15}", i == 0 ? title : "");
    for (Eigen::Index j = 0; j < m.cols(); ++j) {
      out += fmt::format(" {:>13.6g}", m(i, j) + 0.0);
    }
    out += "\n";
  }
  return out;
}

}  // namespace whirl_twin

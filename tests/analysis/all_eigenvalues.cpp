#include "all_eigenvalues.h"

#include <gtest/gtest.h>

#include <Eigen/Eigenvalues>
#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <limits>

namespace whirl_twin {

std::vector<std::complex<double>> allEigenvalues(const Linearization& l) {
  using Long = long double;
  using LongMatrix = Eigen::Matrix<Long, Eigen::Dynamic, Eigen::Dynamic>;
  const Eigen::Index n = l.mass.rows();
  const Eigen::PartialPivLU<LongMatrix> mass(l.mass.cast<Long>());
  const LongMatrix by_q = mass.solve((l.stiffness + l.circulatory).cast<Long>());
  const Long scale = std::exp2(std::round(std::log2(std::sqrt(by_q.cwiseAbs().maxCoeff()))));
  LongMatrix a = LongMatrix::Zero(2 * n, 2 * n);
  a.topRightCorner(n, n).diagonal().setConstant(scale);
  a.bottomLeftCorner(n, n) = -by_q / scale;
  a.bottomRightCorner(n, n) = -mass.solve((l.damping + l.gyroscopic).cast<Long>());
  Eigen::EigenSolver<LongMatrix> solver;
  solver.setMaxIterations(400 * 2 * n).compute(a, false);
  EXPECT_EQ(solver.info(), Eigen::Success);
  std::vector<std::complex<double>> all;
  for (const auto& s : solver.eigenvalues()) {
    all.emplace_back(static_cast<double>(s.real()), static_cast<double>(s.imag()));
  }
  std::sort(all.begin(), all.end(),
            [](const auto& s, const auto& t) { return std::abs(s) < std::abs(t); });
  return all;
}

double worstDifference(const std::vector<std::complex<double>>& found,
                       std::vector<std::complex<double>> all) {
  double worst = found.size() <= all.size() ? 0.0 : std::numeric_limits<double>::infinity();
  for (const std::complex<double>& s : found) {
    if (all.empty()) {
      break;
    }
    const auto nearest = std::min_element(
        all.begin(), all.end(),
        [&](const auto& a, const auto& b) { return std::abs(a - s) < std::abs(b - s); });
    worst = std::max(worst, std::abs(*nearest - s) / std::abs(*nearest));
    all.erase(nearest);
  }
  return worst;
}

}  // namespace whirl_twin

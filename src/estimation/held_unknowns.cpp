#include "estimation/held_unknowns.h"

#include <cmath>
#include <utility>

namespace whirl_twin {

DistanceFromStart::DistanceFromStart(Eigen::VectorXd start, Eigen::VectorXd sizes,
                                     std::vector<Range> ranges)
    : start_(std::move(start)), sizes_(std::move(sizes)), ranges_(std::move(ranges)) {}

bool DistanceFromStart::byTimes(Eigen::Index i, double value) const {
  switch (ranges_[static_cast<std::size_t>(i)]) {
    case Range::kPositive:
      return true;
    case Range::kNotNegative:
      return value > start_[i];
    default:
      return false;
  }
}

double DistanceFromStart::of(Eigen::Index i, double value) const {
  return byTimes(i, value) ? std::log(value / start_[i]) : (value - start_[i]) / sizes_[i];
}

double DistanceFromStart::slope(Eigen::Index i, double value) const {
  return 1.0 / (byTimes(i, value) ? value : sizes_[i]);
}

HeldCost::HeldCost(Eigen::MatrixXd rows, const DistanceFromStart& distance)
    : rows_(std::move(rows)), distance_(distance) {
  mutable_parameter_block_sizes()->push_back(static_cast<int>(rows_.cols()));
  set_num_residuals(static_cast<int>(rows_.rows()));
}

bool HeldCost::Evaluate(double const* const* blocks, double* residuals, double** jacobians) const {
  Eigen::VectorXd away(rows_.cols());
  Eigen::VectorXd slopes(rows_.cols());
  for (Eigen::Index i = 0; i < away.size(); ++i) {
    away[i] = distance_.of(i, blocks[0][i]);
    slopes[i] = distance_.slope(i, blocks[0][i]);
  }
  Eigen::Map<Eigen::VectorXd>(residuals, rows_.rows()) = rows_ * away;
  if (jacobians != nullptr && jacobians[0] != nullptr) {
    using RowMajor = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;
    Eigen::Map<RowMajor>(jacobians[0], rows_.rows(), rows_.cols()) = rows_ * slopes.asDiagonal();
  }
  return true;
}

}  // namespace whirl_twin

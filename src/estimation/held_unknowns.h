// What a fit holds of its unknowns: their distances from where they start.
//
// Where runs tell numbers only as multiples of each other, all may be any number of times as large,
// and it is the times that count: of a number that cannot be 0 the distance is a logarithm. So it
// is of one that can be, a friction say, but only upwards, for 0 is not far from where it starts.
#pragma once

#include <ceres/cost_function.h>

#include <Eigen/Core>
#include <vector>

#include "mechanics/model_description.h"

namespace whirl_twin {

/// Distances from the start, in sizes of the unknowns.
class DistanceFromStart {
 public:
  DistanceFromStart() = default;
  /// ranges: of the unknowns' values; those that are not kAny start above 0, at their size.
  DistanceFromStart(Eigen::VectorXd start, Eigen::VectorXd sizes, std::vector<Range> ranges);

  const Eigen::VectorXd& sizes() const { return sizes_; }
  double of(Eigen::Index unknown, double value) const;     ///< [-], 0 at the start
  double slope(Eigen::Index unknown, double value) const;  ///< of that, by the value

 private:
  /// Is the distance of this value a logarithm?
  bool byTimes(Eigen::Index unknown, double value) const;

  Eigen::VectorXd start_, sizes_;
  std::vector<Range> ranges_;
};

/// rows * distances counts as residuals do [held x unknowns]. Block: the unknowns.
class HeldCost final : public ceres::CostFunction {
 public:
  /// The distance outlives it.
  HeldCost(Eigen::MatrixXd rows, const DistanceFromStart& distance);
  bool Evaluate(double const* const* blocks, double* residuals, double** jacobians) const override;

 private:
  Eigen::MatrixXd rows_;
  const DistanceFromStart& distance_;
};

}  // namespace whirl_twin
